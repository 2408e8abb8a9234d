// Tests of GLSL that is generated for other programs: a minimal program draws with it on the inspector's own map.
#include "app/convert/glsl_export.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "app/convert/glsl_preprocessor.h"
#include "renderer/gl/target.h"
#include "renderer/projection/projection.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/map_storage.h"
#include "shaders/shared/units.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

constexpr const char* kExportVertex = R"(#version 450 core
layout(location = 0) in vec3 position_os;
layout(location = 1) in vec3 normal_os;
layout(location = 2) in vec3 face_os;
uniform vec4 row0, row1, row2;
uniform vec3 normal_row0, normal_row1, normal_row2, eye;
uniform mat4 clip_from_world;
out vec3 position_m, normal_ws;
flat out vec3 face_ws;
void main() {
    vec4 p = vec4(position_os, 1.0);
    position_m = vec3(dot(row0, p), dot(row1, p), dot(row2, p));
    normal_ws = vec3(dot(normal_row0, normal_os), dot(normal_row1, normal_os), dot(normal_row2, normal_os));
    vec3 face = vec3(dot(normal_row0, face_os), dot(normal_row1, face_os), dot(normal_row2, face_os));
    face = normalize(face);
    face_ws = dot(face, eye - position_m) < 0.0 ? -face : face;
    gl_Position = clip_from_world * vec4(position_m, 1.0);
})";

constexpr const char* kExportMain = R"(
in vec3 position_m, normal_ws;
flat in vec3 face_ws;
layout(location = 0) out float visibility_out;
void main() {
    vec3 normal = normalize(normal_ws);
    if (dot(normal, face_ws) < 0.0) normal = -normal;
    visibility_out = shadow_visibility(position_m, face_ws, normal, normal, gl_FragCoord.xy);
})";

GLuint export_shader(GLenum stage, const std::string& text) {
    const GLuint shader = glCreateShader(stage);
    const char* pointer = text.c_str();
    glShaderSource(shader, 1, &pointer, nullptr);
    glCompileShader(shader);
    GLint ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (!ok) {
        char log[4096] = {};
        glGetShaderInfoLog(shader, sizeof log, nullptr, log);
        std::string numbered;
        std::istringstream lines(text);
        int number = 0;
        for (std::string line; std::getline(lines, line);) numbered += fmt::format("{:4} {}\n", ++number, line);
        ADD_FAILURE() << log << numbered.size();
    }
    return shader;
}

/// Minimal program around an exported text.
class ExportedProgram {
public:
    explicit ExportedProgram(const std::string& text) : id_(glCreateProgram()) {
        for (const GLuint shader : {export_shader(GL_VERTEX_SHADER, kExportVertex),
                                    export_shader(GL_FRAGMENT_SHADER, "#version 450 core\n" + text + kExportMain)}) {
            glAttachShader(id_, shader);
            glDeleteShader(shader);
        }
        glLinkProgram(id_);
        GLint ok = 0;
        glGetProgramiv(id_, GL_LINK_STATUS, &ok);
        EXPECT_TRUE(ok);
        glUseProgram(id_);
    }
    ~ExportedProgram() { glDeleteProgram(id_); }
    GLint place(const std::string& name) const { return glGetUniformLocation(id_, name.c_str()); }
    void set(const std::string& name, const glm::mat4& m) const {
        glUniformMatrix4fv(place(name), 1, GL_FALSE, &m[0].x);
    }
    void set(const std::string& name, float v) const { glUniform1f(place(name), v); }
    void set(const std::string& name, const glm::vec2& v) const { glUniform2fv(place(name), 1, &v.x); }
    void set(const std::string& name, const glm::vec3& v) const { glUniform3fv(place(name), 1, &v.x); }
    void set(const std::string& name, const glm::vec4& v) const { glUniform4fv(place(name), 1, &v.x); }

private:
    GLuint id_;
};

void set_wrap(GLuint sampler, const MapSettings& map, bool border) {
    const GLint wrap = map.wrap == MapWrap::Border && border ? GL_CLAMP_TO_BORDER
                       : map.wrap == MapWrap::Repeat         ? GL_REPEAT
                                                             : GL_CLAMP_TO_EDGE;
    const glm::vec4 colour((map.outside == Outside::Lit) != map.reversed_z ? 1.f : 0.f);
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_S, wrap);
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_T, wrap);
    glSamplerParameterfv(sampler, GL_TEXTURE_BORDER_COLOR, &colour.x);
}

/// Samplers as the head of an exported text describes them.
struct ExportSamplers {
    GLuint ids[3] = {};
    explicit ExportSamplers(const Settings& s) {
        glCreateSamplers(3, ids);
        for (int i = 0; i < 3; ++i) {
            const bool linear = i == 2 || (i == 1 && is_bilinear(filter_of(s), s));
            set_wrap(ids[i], s.map, i != 2);
            glSamplerParameteri(ids[i], GL_TEXTURE_MAG_FILTER, linear ? GL_LINEAR : GL_NEAREST);
            glSamplerParameteri(ids[i], GL_TEXTURE_MIN_FILTER,
                                i == 2 && s.filter.mips ? GL_LINEAR_MIPMAP_LINEAR
                                : linear                ? GL_LINEAR
                                                        : GL_NEAREST);
        }
        const bool less = s.map.compare == Compare::Less;
        glSamplerParameteri(ids[1], GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glSamplerParameteri(ids[1], GL_TEXTURE_COMPARE_FUNC,
                            s.map.reversed_z ? (less ? GL_GREATER : GL_GEQUAL) : (less ? GL_LESS : GL_LEQUAL));
    }
    ~ExportSamplers() { glDeleteSamplers(3, ids); }
};

class GlslExport : public FrameTest {
protected:
    /// Draws a scene with the exported text on the maps of a frame, and returns the visibility.
    FloatImage drawn(const Scene& scene, const Settings& s, const FrameResult& frame, const std::string& text) {
        const FittedLight& light = frame.lights.at(0);
        const ExportedProgram program(text);
        const ExportSamplers samplers(s);
        for (const FrameContents::Part& part : frame.contents.parts) {
            if (!part.image->texture) continue;
            const GLuint id = part.image->texture.id();
            const bool maps = part.of == Result::ShadowMaps, moments = part.of == Result::Moments;
            if (maps) {
                bind(shared::UNIT_SHADOW_MAP, id, samplers.ids[0]);
                if (!is_colour(s.map.format)) bind(shared::UNIT_SHADOW_MAP_COMPARE, id, samplers.ids[1]);
            }
            if (moments) bind(shared::UNIT_MOMENTS, id, filter_of(s).moments.summed ? 0 : samplers.ids[2]);
        }
        for (std::size_t i = 0; i < light.views.size(); ++i) {
            const LightView& v = light.views[i];
            const std::string at = fmt::format("[{}]", i);
            program.set("shadow_uvd_from_world" + at,
                        glm::mat4(uvd_from_clip(v.curve.convention) * v.clip_from_relative(glm::dvec3(0))));
            program.set("shadow_near_far_m" + at, glm::vec2(v.curve.near, v.curve.far));
            const double half = v.warped() ? 0 : v.texel_size(1, 2);
            program.set((light.is_perspective() ? "shadow_half_width_tan" : "shadow_half_width_m") + at, float(half));
            if (i < light.chooser.spans.size())
                program.set("shadow_view_ends" + at,
                            glm::vec2(light.chooser.spans[i].ends, light.chooser.spans[i].blends_from));
            const DepthWarp warp = v.curve.warp.value_or(DepthWarp{0, v.curve.near, v.curve.far, 0});
            program.set("shadow_warp" + at, glm::vec4(warp.middle_m, warp.near_m, warp.far_m, warp.rise));
        }
        const Camera& camera = frame.camera;
        const glm::mat4 clip(camera.clip_from_relative(glm::dvec3(0)));
        program.set("shadow_to_light", glm::vec3(light.to_light));
        program.set("shadow_light_position_m", glm::vec3(light.position));
        program.set("shadow_camera_position_m", glm::vec3(camera.eye));
        program.set("shadow_camera_forward", glm::vec3(-camera.axes[2]));
        program.set("shadow_map_origin_m", glm::vec3(0));
        program.set("shadow_clip_from_world", clip);
        program.set("shadow_picture_px", glm::vec2(frame.visibility.width, frame.visibility.height));
        program.set("clip_from_world", clip);
        program.set("eye", glm::vec3(camera.eye));
        return draw_objects(scene, frame, program);
    }

private:
    static void bind(int unit, GLuint texture, GLuint sampler) {
        glBindTextureUnit(GLuint(unit), texture);
        glBindSampler(GLuint(unit), sampler);
    }

    static FloatImage draw_objects(const Scene& scene, const FrameResult& frame, const ExportedProgram& program) {
        const int width = frame.visibility.width, height = frame.visibility.height;
        GLuint images[2], framebuffer, vao, buffer;
        glCreateTextures(GL_TEXTURE_2D, 2, images);
        glTextureStorage2D(images[0], 1, GL_R32F, width, height);
        glTextureStorage2D(images[1], 1, GL_DEPTH_COMPONENT32F, width, height);
        glCreateFramebuffers(1, &framebuffer);
        glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, images[0], 0);
        glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, images[1], 0);
        glCreateVertexArrays(1, &vao);
        const DepthConvention& depth = frame.camera.curve.convention;
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glViewport(0, 0, width, height);
        glClipControl(GL_LOWER_LEFT, depth.zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
        glEnable(GL_DEPTH_TEST);
        glDepthMask(GL_TRUE);
        glDepthFunc(depth.reversed ? GL_GEQUAL : GL_LEQUAL);
        glDisable(GL_BLEND);
        glDisable(GL_SCISSOR_TEST);
        glDisable(GL_POLYGON_OFFSET_FILL);
        const float lit = 1, empty = depth.reversed ? 0 : 1;
        glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, &lit);
        glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &empty);
        glBindVertexArray(vao);
        for (const Object& object : scene.objects) {
            const Mesh& mesh = scene.meshes[std::size_t(object.mesh)];
            std::vector<glm::vec3> vertices;
            for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
                const auto corner = [&](std::size_t k) { return mesh.indices[i + k]; };
                const glm::dvec3 a(mesh.positions[corner(0)]), b(mesh.positions[corner(1)]),
                    c(mesh.positions[corner(2)]);
                const glm::vec3 face(glm::normalize(glm::cross(b - a, c - a)));
                for (std::size_t k = 0; k < 3; ++k)
                    vertices.insert(vertices.end(), {mesh.positions[corner(k)], mesh.normals[corner(k)], face});
            }
            glCreateBuffers(1, &buffer);
            glNamedBufferData(buffer, GLsizeiptr(vertices.size() * sizeof(glm::vec3)), vertices.data(), GL_STATIC_DRAW);
            glBindBuffer(GL_ARRAY_BUFFER, buffer);
            for (GLuint i = 0; i < 3; ++i) {
                glEnableVertexAttribArray(i);
                glVertexAttribPointer(i, 3, GL_FLOAT, GL_FALSE, 36,
                                      reinterpret_cast<const void*>(std::uintptr_t(12 * i)));
            }
            const glm::dmat4 rows = glm::transpose(object.world);
            const glm::dmat3 normals = glm::transpose(glm::inverse(glm::transpose(glm::dmat3(object.world))));
            for (int i = 0; i < 3; ++i) {
                program.set(fmt::format("row{}", i), glm::vec4(rows[i]));
                program.set(fmt::format("normal_row{}", i), glm::vec3(normals[i]));
            }
            const int material = mesh.material;
            const bool both = material < 0 || scene.materials[std::size_t(material)].double_sided;
            both ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
            glCullFace(GL_BACK);
            glFrontFace(glm::determinant(glm::dmat3(object.world)) < 0 ? GL_CW : GL_CCW);
            glDrawArrays(GL_TRIANGLES, 0, GLsizei(vertices.size() / 3));
            glDeleteBuffers(1, &buffer);
        }
        std::vector<float> pixels(std::size_t(width) * std::size_t(height));
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glReadPixels(0, 0, width, height, GL_RED, GL_FLOAT, pixels.data());
        FloatImage out{.width = width, .height = height, .channels = 1};
        for (int y = height - 1; y >= 0; --y)
            out.data.insert(out.data.end(), pixels.begin() + std::ptrdiff_t(y) * width,
                            pixels.begin() + std::ptrdiff_t(y + 1) * width);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glUseProgram(0);
        glBindVertexArray(0);
        glDeleteVertexArrays(1, &vao);
        glDeleteFramebuffers(1, &framebuffer);
        glDeleteTextures(2, images);
        return out;
    }

protected:
    /// Draws one case both ways and expects equal pictures.
    ///
    /// Both programs compute the same expressions in single precision. A driver may order them differently (two
    /// products and a sum, or one fused step), so a compared depth may differ by its last place. A comparison is then
    /// decided otherwise only where both depths are equal but for that: a pixel in a thousand, at most. Elsewhere the
    /// weights' rounding of 1e-5 (Tolerance) remains.
    void expect_equal_pictures(const Scene& scene, const Sets& sets) {
        Settings s = settings_for(scene, sets);
        set_setting(s, "map.origin", "world");
        FrameResult frame;
        const FloatImage ours = visibility(scene, s, {.width = 160, .height = 90}, &frame);
        const ExportedCode code =
            lookup_glsl(s, lookup_facts(s, frame.lights.at(0), frame.map_size, renderer.driver().subpixel_bits));
        const FloatImage theirs = drawn(scene, s, frame, code.text);
        const std::size_t dark = values_between(ours, -1, 0.5f);
        EXPECT_GT(dark, 20u) << "the picture has no shadow";
        EXPECT_LT(dark, ours.data.size() / 2);
        const bool four = filter_of(s).moments.rule == BoundRule::FourMoments && filter_of(s).moments.names.size() == 4;
        const float rounding = four ? float(std::ldexp(1.0, -24) / s.filter.moment_bias) : 1e-4f;
        EXPECT_LE(differing_values(ours, theirs, rounding), ours.data.size() / 1000);
        if (HasNonfatalFailure()) {
            std::ofstream(fresh_test_folder() / "failed.glsl") << code.text;
        }
    }
};

SI_TEST_IS(Later, GlslExport, EveryKernelAndBiasDrawsTheSamePicture);
TEST_F(GlslExport, EveryKernelAndBiasDrawsTheSamePicture) {
    const Scene scene = load_scene("boxes");
    for (const Filter& filter : filters())
        for (const Bias& bias : biases()) {
            if (bias.stage != BiasStage::Compare) continue;
            SCOPED_TRACE(fmt::format("{} with {}", filter.key, bias.key));
            expect_equal_pictures(scene, {{"filter.kernel", std::string(filter.key)},
                                          {"bias.kind", std::string(bias.key)},
                                          {"bias.constant", "1"},
                                          {"bias.slope", "2"},
                                          {"bias.normal", "0.7"},
                                          {"map.resolution", "256"}});
        }
}

SI_TEST_IS(Later, GlslExport, LightsFormatsAndConventionsDrawTheSamePicture);
TEST_F(GlslExport, LightsFormatsAndConventionsDrawTheSamePicture) {
    const Scene scene = load_scene("boxes");
    const Sets cases[] = {{{"map.reversed_z", "true"}},
                          {{"map.format", "d16"}},
                          {{"map.format", "linear"}},
                          {{"map.compare", "less"}},
                          {{"filter.method", "sampler"}, {"filter.kernel", "pcf"}, {"bias.kind", "constant"}},
                          {{"bias.unit", "metres"}, {"bias.kind", "constant"}, {"bias.constant", "0.01"}},
                          {{"bias.normal_source", "shading"}, {"bias.normal", "1"}},
                          {{"bias.raster_slope", "2"}, {"bias.raster_units", "4"}},
                          {{"light.cascades", "3"}},
                          {{"light.type", "spot"}},
                          {{"light.type", "point"}},
                          {{"light.fit", "lispsm"}},
                          {{"filter.kernel", "vsm"}, {"filter.mips", "true"}}};
    for (const Sets& sets : cases) {
        SCOPED_TRACE(sets[0].first + "=" + sets[0].second);
        Sets all{{"map.resolution", "256"}};
        all.insert(all.end(), sets.begin(), sets.end());
        expect_equal_pictures(scene, all);
    }
}

}  // namespace
}  // namespace si
