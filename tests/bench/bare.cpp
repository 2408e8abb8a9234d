#include "tests/bench/bare.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "renderer/base/error.h"

namespace si {
namespace {

struct Vertex {
    glm::vec3 position, normal;
    glm::vec3 colour;
    glm::vec2 uv;
};

GLuint shader(GLenum stage, const std::string& text) {
    const std::string whole = "#version 450 core\n" + text;
    const char* p = whole.c_str();
    const GLuint id = glCreateShader(stage);
    glShaderSource(id, 1, &p, nullptr);
    glCompileShader(id);
    GLint ok = 0;
    glGetShaderiv(id, GL_COMPILE_STATUS, &ok);
    if (!ok) {
        char log[2000];
        glGetShaderInfoLog(id, sizeof log, nullptr, log);
        throw Error(log);
    }
    return id;
}

gl::Program program(const std::string& vertex, const std::string& fragment) {
    auto p = gl::Program::create("bare");
    const GLuint vs = shader(GL_VERTEX_SHADER, vertex), fs = shader(GL_FRAGMENT_SHADER, fragment);
    glAttachShader(p.id(), vs);
    glAttachShader(p.id(), fs);
    glLinkProgram(p.id());
    glDeleteShader(vs);
    glDeleteShader(fs);
    return p;
}

constexpr const char* kShadeVertex = R"(
layout(location=0) in vec3 p; layout(location=1) in vec3 n; layout(location=2) in vec3 c; layout(location=3) in vec2 t;
uniform mat4 clip;
out vec3 pos; out vec3 nor; out vec3 col; out vec2 uv;
void main(){ pos=p; nor=n; col=c; uv=t; gl_Position=clip*vec4(p,1); })";
constexpr const char* kDepthVertex =
    "layout(location=0) in vec3 p; uniform mat4 clip; void main(){gl_Position=clip*vec4(p,1);}";
constexpr const char* kMaskedDepthVertex = R"(
layout(location=0) in vec3 p; layout(location=3) in vec2 t; uniform mat4 clip; out vec2 uv;
void main(){ uv=t; gl_Position=clip*vec4(p,1); })";
constexpr const char* kMaskedDepthFragment = R"(
in vec2 uv; uniform float cutoff; layout(binding=1) uniform sampler2D base;
void main(){ if(texture(base,uv).a<cutoff) discard; })";

/// @param look "" of base colours, "TEXTURED", "MASKED"
std::string shade_fragment(int kernel, const std::string& look) {
    std::string out = (look.empty() ? "" : "#define TEXTURED\n#define " + (look == "MASKED" ? look : "PLAIN") + "\n") +
                      "#define K " + std::to_string(kernel) + R"(
in vec3 pos; in vec3 nor; in vec3 col; in vec2 uv; out vec4 o;
layout(binding=1) uniform sampler2D base; uniform float cutoff;
uniform mat4 uvd; uniform vec3 to_light; uniform vec3 eye; uniform float size; uniform float bias;
layout(binding=0) uniform sampler2D map;
float visible(vec3 s){
#if K == 0
 return 1.0;
#elif K < 0
 return s.z <= texture(map,s.xy).r ? 1.0 : 0.0;
#else
 const int R=K/2; float t=1.0/size; vec2 at=s.xy*size-0.5, b=floor(at), f=at-b; float sum=0.0;
 for(int y=0;y<=K;y+=2){ float y0=y==0?1.0-f.y:1.0,y1=y==K-1?f.y:1.0;
  for(int x=0;x<=K;x+=2){ float x0=x==0?1.0-f.x:1.0,x1=x==K-1?f.x:1.0;
   vec4 g=step(vec4(s.z),textureGather(map,(b+vec2(x-R+1,y-R+1))*t));
   sum+=dot(g,vec4(x0*y1,x1*y1,x1*y0,x0*y0)); } }
 return sum/float(K*K);
#endif
}
void main(){
 vec3 albedo=col;
#ifdef TEXTURED
 vec4 t=texture(base,uv); albedo*=t.rgb;
#endif
 vec3 n=normalize(nor), v=normalize(eye-pos), h;
#ifdef MASKED
 if(t.a<cutoff) discard;
#endif
 if(!gl_FrontFacing) n=-n;
 h=normalize(v+to_light);
 vec3 s=(uvd*vec4(pos,1)).xyz; s.z-=bias; float nl=max(dot(n,to_light),0.0);
 float vis=visible(s);
 vec3 rgb=(0.25+vis*(0.75*nl+(nl>0.0?0.15*pow(max(dot(n,h),0.0),32.0):0.0)))*albedo;
 rgb=clamp(rgb,0.0,1.0);
 o=vec4(mix(12.92*rgb,1.055*pow(rgb,vec3(1.0/2.4))-0.055,greaterThan(rgb,vec3(0.0031308))),1); })";
    return out;
}

void draw_elements(std::size_t first, std::size_t count) {
    glDrawElements(GL_TRIANGLES, GLsizei(count), GL_UNSIGNED_INT, reinterpret_cast<const void*>(first * 4));
}

GLenum wrap(TextureWrap w) {
    return w == TextureWrap::Clamp ? GL_CLAMP_TO_EDGE : w == TextureWrap::Mirror ? GL_MIRRORED_REPEAT : GL_REPEAT;
}

/// As the renderer uploads and samples them.
gl::Texture upload(const Texture& t) {
    auto texture = gl::Texture::create("bare texture", GLenum(GL_TEXTURE_2D));
    const int levels = t.mipmaps ? int(std::log2(std::max(t.width, t.height))) + 1 : 1;
    glTextureStorage2D(texture.id(), levels, t.srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, t.width, t.height);
    glTextureSubImage2D(texture.id(), 0, 0, 0, t.width, t.height, GL_RGBA, GL_UNSIGNED_BYTE, t.rgba.data());
    glGenerateTextureMipmap(texture.id());
    glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_S, GLint(wrap(t.wrap_s)));
    glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_T, GLint(wrap(t.wrap_t)));
    glTextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, t.nearest_mag ? GL_NEAREST : GL_LINEAR);
    glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER,
                        levels > 1      ? GL_LINEAR_MIPMAP_LINEAR
                        : t.nearest_min ? GL_NEAREST
                                        : GL_LINEAR);
    if (levels > 1 && epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic"))
        glTextureParameterf(texture.id(), GL_TEXTURE_MAX_ANISOTROPY_EXT, 4);
    return texture;
}

}  // namespace

BareForward::Group& BareForward::group_of(const Scene& scene, const Mesh& mesh) {
    Group wanted;
    if (mesh.material >= 0 && materials_ == BareMaterials::Textures) {
        const Material& m = scene.materials[std::size_t(mesh.material)];
        if (m.normal_texture >= 0 || m.alpha == AlphaMode::Blend || m.unlit)
            throw Error("the bare program draws no normal maps, no blended and no unlit materials: " + m.name);
        wanted.texture = m.base_colour_texture;
        wanted.masked = m.alpha == AlphaMode::Mask && m.base_colour_texture >= 0;
        wanted.double_sided = m.double_sided;
        wanted.cutoff = m.alpha_cutoff;
    }
    for (Group& g : groups_)
        if (g.texture == wanted.texture && g.masked == wanted.masked && g.double_sided == wanted.double_sided &&
            (!g.masked || g.cutoff == wanted.cutoff))
            return g;
    return groups_.emplace_back(wanted);
}

BareForward::BareForward(const Scene& scene, int kernel_size, int map_resolution, int width, int height,
                         BareMaterials materials)
    : kernel_(kernel_size), resolution_(map_resolution), width_(width), height_(height), materials_(materials) {
    origin_ = scene.bounds.centre();
    std::vector<Vertex> vertices;
    for (const Object& object : scene.objects) {
        const Mesh& mesh = scene.meshes[std::size_t(object.mesh)];
        const glm::mat3 normal(glm::transpose(glm::inverse(glm::dmat3(object.world))));
        const glm::vec3 colour =
            mesh.material < 0 ? glm::vec3(0.8f) : glm::vec3(scene.materials[std::size_t(mesh.material)].base_colour);
        const auto base = std::uint32_t(vertices.size());
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            vertices.push_back({glm::vec3(glm::dvec3(object.world * glm::dvec4(mesh.positions[i], 1)) - origin_),
                                normal * mesh.normals[i], colour, mesh.uv.empty() ? glm::vec2(0) : mesh.uv[i]});
        Group& group = group_of(scene, mesh);
        for (const std::uint32_t i : mesh.indices) group.indices.push_back(base + i);
    }
    std::vector<std::uint32_t> indices;
    for (Group& group : groups_) {
        group.first = indices.size();
        indices.insert(indices.end(), group.indices.begin(), group.indices.end());
    }
    if (materials_ == BareMaterials::Textures)
        for (const Texture& t : scene.textures) textures_.push_back(upload(t));
    vertices_ = gl::Buffer::create("bare vertices");
    indices_ = gl::Buffer::create("bare indices");
    glNamedBufferStorage(vertices_.id(), GLsizeiptr(vertices.size() * sizeof(Vertex)), vertices.data(), 0);
    glNamedBufferStorage(indices_.id(), GLsizeiptr(indices.size() * 4), indices.data(), 0);
    vao_ = gl::VertexArray::create("bare");
    for (GLuint a = 0; a < 4; ++a) {
        glEnableVertexArrayAttrib(vao_.id(), a);
        glVertexArrayAttribFormat(vao_.id(), a, a == 3 ? 2 : 3, GL_FLOAT, GL_FALSE, a * 12);
        glVertexArrayAttribBinding(vao_.id(), a, 0);
    }
    glVertexArrayVertexBuffer(vao_.id(), 0, vertices_.id(), 0, sizeof(Vertex));
    glVertexArrayElementBuffer(vao_.id(), indices_.id());
    depth_program_ = program(kDepthVertex, "void main(){}");
    masked_depth_program_ = program(kMaskedDepthVertex, kMaskedDepthFragment);
    shade_program_ = program(kShadeVertex, shade_fragment(kernel_, ""));
    textured_program_ = program(kShadeVertex, shade_fragment(kernel_, "TEXTURED"));
    masked_program_ = program(kShadeVertex, shade_fragment(kernel_, "MASKED"));
    map_.ensure("bare map", GL_DEPTH_COMPONENT32F, resolution_, resolution_);
    colour_.ensure("bare colour", GL_RGBA8, width_, height_);
    depth_.ensure("bare depth", GL_DEPTH_COMPONENT32F, width_, height_);
    map_framebuffer_ = gl::make_framebuffer("bare map", nullptr, &map_);
    framebuffer_ = gl::make_framebuffer("bare", &colour_, &depth_);
}

void BareForward::use(const gl::Program& program, const Group& group, const glm::mat4& clip) {
    glUseProgram(program.id());
    glUniformMatrix4fv(glGetUniformLocation(program.id(), "clip"), 1, GL_FALSE, glm::value_ptr(clip));
    glUniform1f(glGetUniformLocation(program.id(), "cutoff"), group.cutoff);
    if (group.texture >= 0) glBindTextureUnit(1, textures_[std::size_t(group.texture)].id());
    glBindSampler(1, 0);
}

void BareForward::draw(const Camera& camera, const FittedLight& light, bool depth_pass, bool shade_pass) {
    const LightView& view = light.views.front();
    const glm::dmat4 light_clip = view.clip_from_relative(origin_);
    const auto uniform = [](const gl::Program& p, const char* name) { return glGetUniformLocation(p.id(), name); };
    glBindVertexArray(vao_.id());
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glDisable(GL_POLYGON_OFFSET_FILL);
    if (depth_pass && kernel_ != 0) {
        const float one = 1;
        glBindFramebuffer(GL_FRAMEBUFFER, map_framebuffer_.id());
        glViewport(0, 0, resolution_, resolution_);
        glClearNamedFramebufferfv(map_framebuffer_.id(), GL_DEPTH, 0, &one);
        glDepthFunc(GL_LESS);
        glDisable(GL_CULL_FACE);
        for (const Group& group : groups_) {
            use(group.masked ? masked_depth_program_ : depth_program_, group, glm::mat4(light_clip));
            draw_elements(group.first, group.indices.size());
        }
    }
    if (!shade_pass) return;
    const float zero = 0;
    const glm::vec4 background(0.155f, 0.165f, 0.185f, 1);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glViewport(0, 0, width_, height_);
    glClearNamedFramebufferfv(framebuffer_.id(), GL_DEPTH, 0, &zero);
    glClearNamedFramebufferfv(framebuffer_.id(), GL_COLOR, 0, &background.x);
    glDepthFunc(GL_GREATER);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glm::dmat4 half(1.0);
    half[0][0] = half[1][1] = half[3][0] = half[3][1] = 0.5;
    const glm::mat4 clip(camera.clip_from_relative(origin_)), uvd(half * light_clip);
    const glm::vec3 eye(camera.eye - origin_), to_light(light.to_light);
    glBindTextureUnit(0, map_.texture.id());
    glBindSampler(0, 0);
    for (const Group& group : groups_) {
        const gl::Program& p = group.masked ? masked_program_ : group.texture >= 0 ? textured_program_ : shade_program_;
        group.double_sided ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
        use(p, group, clip);
        glUniformMatrix4fv(uniform(p, "uvd"), 1, GL_FALSE, glm::value_ptr(uvd));
        glUniform3fv(uniform(p, "eye"), 1, &eye.x);
        glUniform3fv(uniform(p, "to_light"), 1, &to_light.x);
        glUniform1f(uniform(p, "size"), float(resolution_));
        glUniform1f(uniform(p, "bias"), float(3 * view.texel_size(1, resolution_) * view.curve.slope(1)));
        draw_elements(group.first, group.indices.size());
    }
}

std::vector<std::uint8_t> BareForward::picture() const {
    std::vector<std::uint8_t> rgba(std::size_t(width_) * std::size_t(height_) * 4);
    glGetTextureImage(colour_.texture.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(rgba.size()), rgba.data());
    return rgba;
}

}  // namespace si
