// Minimal OpenGL renderer of benchmarks: geometry, programs, targets and passes.
#include "tests/bench/bare.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <numeric>
#include <string>

#include "renderer/base/error.h"
#include "tests/bench/bare_shaders.h"

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

GLint uniform(const gl::Program& p, const char* name) {
    return glGetUniformLocation(p.id(), name);
}

void draw_elements(std::size_t first, std::size_t count) {
    glDrawElements(GL_TRIANGLES, GLsizei(count), GL_UNSIGNED_INT, reinterpret_cast<const void*>(first * 4));
}

GLenum wrap(TextureWrap w) {
    return w == TextureWrap::Clamp ? GL_CLAMP_TO_EDGE : w == TextureWrap::Mirror ? GL_MIRRORED_REPEAT : GL_REPEAT;
}

/// Uploads a texture as the renderer does.
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

/// Returns the scene's objects in drawing order.
std::vector<const Object*> drawing_order(const Scene& scene, bool large_last) {
    std::vector<const Object*> order;
    for (const Object& o : scene.objects) order.push_back(&o);
    const auto radius_m = [&](const Object* o) {
        return scene.meshes[std::size_t(o->mesh)].bounds.transformed(o->world).radius();
    };
    if (large_last)
        std::stable_sort(order.begin(), order.end(),
                         [&](const Object* a, const Object* b) { return radius_m(a) < radius_m(b); });
    return order;
}

gl::Buffer upload(const char* label, const void* data, std::size_t bytes) {
    auto buffer = gl::Buffer::create(label);
    glNamedBufferStorage(buffer.id(), GLsizeiptr(bytes), data, 0);
    return buffer;
}

}  // namespace

BareForward::Group& BareForward::group_of(const Scene& scene, const Mesh& mesh) {
    Group wanted;
    if (mesh.material >= 0 && options_.materials == BareMaterials::Textures) {
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

BareForward::BareForward(const Scene& scene, const BareOptions& options, int map_resolution, int width, int height)
    : options_(options), resolution_(map_resolution), width_(width), height_(height) {
    make_geometry(scene);
    if (options_.materials == BareMaterials::Textures)
        for (const Texture& t : scene.textures) textures_.push_back(upload(t));
    make_programs();
    make_targets();
}

void BareForward::make_geometry(const Scene& scene) {
    origin_ = scene.bounds.centre();
    std::vector<Vertex> vertices;
    std::vector<glm::vec3> positions;
    for (const Object* object : drawing_order(scene, options_.large_last)) {
        const Mesh& mesh = scene.meshes[std::size_t(object->mesh)];
        const glm::mat3 normal(glm::transpose(glm::inverse(glm::dmat3(object->world))));
        const glm::vec3 colour =
            mesh.material < 0 ? glm::vec3(0.8f) : glm::vec3(scene.materials[std::size_t(mesh.material)].base_colour);
        const auto base = std::uint32_t(vertices.size());
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            positions.emplace_back(glm::dvec3(object->world * glm::dvec4(mesh.positions[i], 1)) - origin_);
            vertices.push_back(
                {positions.back(), normal * mesh.normals[i], colour, mesh.uv.empty() ? glm::vec2(0) : mesh.uv[i]});
        }
        Group& group = group_of(scene, mesh);
        for (const std::uint32_t i : mesh.indices) group.indices.push_back(base + i);
    }
    std::vector<std::uint32_t> indices;
    for (Group& group : groups_) {
        group.first = indices.size();
        indices.insert(indices.end(), group.indices.begin(), group.indices.end());
    }
    vertices_ = upload("bare vertices", vertices.data(), vertices.size() * sizeof(Vertex));
    positions_ = upload("bare positions", positions.data(), positions.size() * sizeof(glm::vec3));
    indices_ = upload("bare indices", indices.data(), indices.size() * 4);
    no_vertices_ = gl::VertexArray::create("bare, no vertices");
    const auto lay_out = [&](gl::VertexArray& vao, const gl::Buffer& from, GLuint attributes, std::size_t stride) {
        vao = gl::VertexArray::create("bare");
        for (GLuint a = 0; a < attributes; ++a) {
            glEnableVertexArrayAttrib(vao.id(), a);
            glVertexArrayAttribFormat(vao.id(), a, a == 3 ? 2 : 3, GL_FLOAT, GL_FALSE, a * 12);
            glVertexArrayAttribBinding(vao.id(), a, 0);
        }
        glVertexArrayVertexBuffer(vao.id(), 0, from.id(), 0, GLsizei(stride));
        glVertexArrayElementBuffer(vao.id(), indices_.id());
    };
    lay_out(vao_, vertices_, 4, sizeof(Vertex));
    lay_out(positions_vao_, positions_, 1, sizeof(glm::vec3));
}

void BareForward::make_programs() {
    depth_program_ = program(kBareDepthVertex, "void main(){}");
    masked_depth_program_ = program(kBareMaskedDepthVertex, kBareMaskedDepthFragment);
    for (int axis = 0; axis < 2; ++axis) blur_program_[axis] = program(kBareFullscreenVertex, bare_blur_fragment(axis));
    const auto make = [&](Programs& programs, BarePass pass) {
        for (int look = 0; look < 3; ++look)
            programs.looks[look] = program(bare_camera_vertex(options_, pass),
                                           bare_camera_fragment(options_, pass, BareLook(look), resolution_));
    };
    make(shade_programs_, options_.separate_visibility ? BarePass::ReadsVisibility : BarePass::Forward);
    if (options_.separate_visibility) make(visibility_programs_, BarePass::Visibility);
}

void BareForward::make_targets() {
    map_.ensure("bare map", GL_DEPTH_COMPONENT32F, resolution_, resolution_);
    colour_.ensure("bare colour", GL_RGBA8, width_, height_);
    depth_.ensure("bare depth", GL_DEPTH_COMPONENT32F, width_, height_);
    map_framebuffer_ = gl::make_framebuffer("bare map", nullptr, &map_);
    framebuffer_ = gl::make_framebuffer("bare", &colour_, &depth_);
    if (options_.separate_visibility) {
        visibility_.ensure("bare visibility", GL_R32F, width_, height_);
        visibility_framebuffer_ = gl::make_framebuffer("bare visibility", &visibility_, &depth_);
    }
    for (int i = 0; i < 2 && options_.kernel == BareKernel::Vsm; ++i) {
        moments_[i].ensure("bare moments", GL_RG32F, resolution_, resolution_);
        moments_framebuffer_[i] = gl::make_framebuffer("bare moments", &moments_[i], nullptr);
        glTextureParameteri(moments_[i].texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTextureParameteri(moments_[i].texture.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    }
    compare_ = gl::Sampler::create("bare comparison");
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glSamplerParameteri(compare_.id(), filter, GL_LINEAR);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glSamplerParameteri(compare_.id(), axis, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(compare_.id(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
}

void BareForward::use(const gl::Program& program, const Group& group, const glm::mat4& clip) {
    glUseProgram(program.id());
    glUniformMatrix4fv(uniform(program, "clip"), 1, GL_FALSE, glm::value_ptr(clip));
    if (group.texture < 0) return;
    glUniform1f(uniform(program, "cutoff"), group.cutoff);
    glBindTextureUnit(1, textures_[std::size_t(group.texture)].id());
    glBindSampler(1, 0);
}

void BareForward::draw_map(const FittedLight& light) {
    const float one = 1;
    const glm::mat4 clip(light.views.front().clip_from_relative(origin_));
    glBindFramebuffer(GL_FRAMEBUFFER, map_framebuffer_.id());
    glViewport(0, 0, resolution_, resolution_);
    glClearNamedFramebufferfv(map_framebuffer_.id(), GL_DEPTH, 0, &one);
    glDepthFunc(GL_LESS);
    for (const Group& group : groups_) {
        options_.cull_casters && !group.double_sided ? glEnable(GL_CULL_FACE) : glDisable(GL_CULL_FACE);
        glBindVertexArray(group.masked ? vao_.id() : positions_vao_.id());
        use(group.masked ? masked_depth_program_ : depth_program_, group, clip);
        draw_elements(group.first, group.indices.size());
    }
}

void BareForward::draw_moments() {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glBindVertexArray(no_vertices_.id());
    for (int axis = 0; axis < 2; ++axis) {
        glBindFramebuffer(GL_FRAMEBUFFER, moments_framebuffer_[axis].id());
        glUseProgram(blur_program_[axis].id());
        glBindTextureUnit(0, axis == 0 ? map_.texture.id() : moments_[0].texture.id());
        glBindSampler(0, 0);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    glEnable(GL_DEPTH_TEST);
}

void BareForward::draw_from_camera(const Programs& programs, const Camera& camera, const FittedLight& light) {
    const LightView& view = light.views.front();
    glm::dmat4 half(1.0);
    half[0][0] = half[1][1] = half[3][0] = half[3][1] = 0.5;
    const glm::mat4 clip(camera.clip_from_relative(origin_)), uvd(half * view.clip_from_relative(origin_));
    const glm::vec3 eye(camera.eye - origin_), to_light(light.to_light);
    const double texel_m = view.texel_size(1, resolution_), per_m = view.curve.slope(1);
    glBindVertexArray(vao_.id());
    for (const Group& group : groups_) {
        const gl::Program& p = programs.of(group);
        group.double_sided ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
        use(p, group, clip);
        glUniformMatrix4fv(uniform(p, "uvd"), 1, GL_FALSE, glm::value_ptr(uvd));
        glUniform3fv(uniform(p, "eye"), 1, &eye.x);
        glUniform3fv(uniform(p, "to_light"), 1, &to_light.x);
        glUniform1f(uniform(p, "bias"), float(3 * texel_m * per_m));
        glUniform2f(uniform(p, "penumbra"), float(light.size / per_m / texel_m), 0);
        draw_elements(group.first, group.indices.size());
    }
}

void BareForward::draw(const Camera& camera, const FittedLight& light, bool depth_pass, bool shade_pass) {
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glFrontFace(GL_CCW);
    glCullFace(GL_BACK);
    if (depth_pass && options_.kernel != BareKernel::None) {
        draw_map(light);
        if (options_.kernel == BareKernel::Vsm) draw_moments();
    }
    if (!shade_pass) return;
    const float zero = 0, lit = 1;
    const glm::vec4 background(0.155f, 0.165f, 0.185f, 1);
    glViewport(0, 0, width_, height_);
    glDepthFunc(GL_GEQUAL);
    glBindTextureUnit(0, options_.kernel == BareKernel::Vsm ? moments_[1].texture.id() : map_.texture.id());
    glBindSampler(0, options_.kernel == BareKernel::Sampler ? compare_.id() : 0);
    glClearNamedFramebufferfv(framebuffer_.id(), GL_DEPTH, 0, &zero);
    if (options_.separate_visibility) {
        glBindFramebuffer(GL_FRAMEBUFFER, visibility_framebuffer_.id());
        glClearNamedFramebufferfv(visibility_framebuffer_.id(), GL_COLOR, 0, &lit);
        draw_from_camera(visibility_programs_, camera, light);
        glBindTextureUnit(2, visibility_.texture.id());
        glBindSampler(2, 0);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glClearNamedFramebufferfv(framebuffer_.id(), GL_COLOR, 0, &background.x);
    draw_from_camera(shade_programs_, camera, light);
}

std::vector<std::uint8_t> BareForward::picture() const {
    std::vector<std::uint8_t> rgba(std::size_t(width_) * std::size_t(height_) * 4);
    glGetTextureImage(colour_.texture.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(rgba.size()), rgba.data());
    return rgba;
}

}  // namespace si
