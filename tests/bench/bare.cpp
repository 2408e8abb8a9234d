#include "tests/bench/bare.h"

#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "renderer/error.h"

namespace si {
namespace {

struct Vertex {
    glm::vec3 position, normal;
    glm::vec3 colour;
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
layout(location=0) in vec3 p; layout(location=1) in vec3 n; layout(location=2) in vec3 c;
uniform mat4 clip;
out vec3 pos; out vec3 nor; out vec3 col;
void main(){ pos=p; nor=n; col=c; gl_Position=clip*vec4(p,1); })";

std::string shade_fragment(int kernel) {
    std::string out = "#define K " + std::to_string(kernel) + R"(
in vec3 pos; in vec3 nor; in vec3 col; out vec4 o;
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
void main(){ vec3 n=normalize(nor), v=normalize(eye-pos), h=normalize(v+to_light);
 vec3 s=(uvd*vec4(pos,1)).xyz; s.z-=bias; float nl=max(dot(n,to_light),0.0);
 float vis=visible(s);
 vec3 rgb=(0.25+vis*(0.75*nl+(nl>0.0?0.15*pow(max(dot(n,h),0.0),32.0):0.0)))*col;
 rgb=clamp(rgb,0.0,1.0);
 o=vec4(mix(12.92*rgb,1.055*pow(rgb,vec3(1.0/2.4))-0.055,greaterThan(rgb,vec3(0.0031308))),1); })";
    return out;
}

}  // namespace

BareForward::BareForward(const Scene& scene, int kernel_size, int map_resolution, int width, int height)
    : kernel_(kernel_size), resolution_(map_resolution), width_(width), height_(height) {
    origin_ = scene.bounds.centre();
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    for (const Object& object : scene.objects) {
        const Mesh& mesh = scene.meshes[std::size_t(object.mesh)];
        const glm::mat3 normal(glm::transpose(glm::inverse(glm::dmat3(object.world))));
        const glm::vec3 colour = mesh.material < 0 ? glm::vec3(0.8f)
                                                   : glm::vec3(scene.materials[std::size_t(mesh.material)].base_colour);
        const auto base = std::uint32_t(vertices.size());
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            vertices.push_back({glm::vec3(glm::dvec3(object.world * glm::dvec4(mesh.positions[i], 1)) - origin_),
                                normal * mesh.normals[i], colour});
        for (const std::uint32_t i : mesh.indices) indices.push_back(base + i);
    }
    count_ = GLsizei(indices.size());
    vertices_ = gl::Buffer::create("bare vertices");
    indices_ = gl::Buffer::create("bare indices");
    glNamedBufferStorage(vertices_.id(), GLsizeiptr(vertices.size() * sizeof(Vertex)), vertices.data(), 0);
    glNamedBufferStorage(indices_.id(), GLsizeiptr(indices.size() * 4), indices.data(), 0);
    vao_ = gl::VertexArray::create("bare");
    for (GLuint a = 0; a < 3; ++a) {
        glEnableVertexArrayAttrib(vao_.id(), a);
        glVertexArrayAttribFormat(vao_.id(), a, 3, GL_FLOAT, GL_FALSE, a * 12);
        glVertexArrayAttribBinding(vao_.id(), a, 0);
    }
    glVertexArrayVertexBuffer(vao_.id(), 0, vertices_.id(), 0, sizeof(Vertex));
    glVertexArrayElementBuffer(vao_.id(), indices_.id());
    depth_program_ = program(
        "layout(location=0) in vec3 p; uniform mat4 clip; void main(){gl_Position=clip*vec4(p,1);}", "void main(){}");
    shade_program_ = program(kShadeVertex, shade_fragment(kernel_));
    map_.ensure("bare map", GL_DEPTH_COMPONENT32F, resolution_, resolution_);
    colour_.ensure("bare colour", GL_RGBA8, width_, height_);
    depth_.ensure("bare depth", GL_DEPTH_COMPONENT32F, width_, height_);
    map_framebuffer_ = gl::make_framebuffer("bare map", nullptr, &map_);
    framebuffer_ = gl::make_framebuffer("bare", &colour_, &depth_);
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
        glUseProgram(depth_program_.id());
        const glm::mat4 clip(light_clip);
        glUniformMatrix4fv(uniform(depth_program_, "clip"), 1, GL_FALSE, glm::value_ptr(clip));
        glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
    }
    if (!shade_pass) return;
    const float zero = 0;
    const glm::vec4 background(0.155f, 0.165f, 0.185f, 1);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glViewport(0, 0, width_, height_);
    glClearNamedFramebufferfv(framebuffer_.id(), GL_DEPTH, 0, &zero);
    glClearNamedFramebufferfv(framebuffer_.id(), GL_COLOR, 0, &background.x);
    glDepthFunc(GL_GREATER);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glUseProgram(shade_program_.id());
    glm::dmat4 half(1.0);
    half[0][0] = half[1][1] = half[3][0] = half[3][1] = 0.5;
    const glm::mat4 clip(camera.clip_from_relative(origin_)), uvd(half * light_clip);
    const glm::vec3 eye(camera.eye - origin_), to_light(light.to_light);
    glUniformMatrix4fv(uniform(shade_program_, "clip"), 1, GL_FALSE, glm::value_ptr(clip));
    glUniformMatrix4fv(uniform(shade_program_, "uvd"), 1, GL_FALSE, glm::value_ptr(uvd));
    glUniform3fv(uniform(shade_program_, "eye"), 1, &eye.x);
    glUniform3fv(uniform(shade_program_, "to_light"), 1, &to_light.x);
    glUniform1f(uniform(shade_program_, "size"), float(resolution_));
    glUniform1f(uniform(shade_program_, "bias"), float(3 * view.texel_size(1, resolution_) * view.curve.slope(1)));
    glBindTextureUnit(0, map_.texture.id());
    glBindSampler(0, 0);
    glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace si
