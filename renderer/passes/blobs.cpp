// Pass that draws blob shadows: a soft disc below each caster, along the light.
#include "renderer/passes/blobs.h"

#include <algorithm>
#include <cmath>

#include "renderer/gl/driver_failure.h"
#include "renderer/passes/casters.h"
#include "renderer/settings/sources.h"

namespace si {
namespace {

constexpr double kMaxCasterShare = 0.25;  ///< share of the scene's radius; wider casters carry others and have no blob

/// Returns the discs of a light: centre relative to the frame's origin, and radius, metres.
std::vector<glm::vec4> discs(const FrameState& f, const FittedLight& light) {
    std::vector<glm::vec4> out;
    const double widest = kMaxCasterShare * f.scene.bounds.radius();
    for (const Object& object : f.scene.objects) {
        if (!can_cast(f.scene, f.settings, object)) continue;
        const Bounds& local = f.scene.meshes[std::size_t(object.mesh)].bounds;
        const glm::dvec3 middle(object.world * glm::dvec4(local.centre(), 1));
        const glm::dvec3 axis =
            light.type == LightType::Directional ? light.to_light : glm::normalize(light.position - middle);
        // Half width of a box along a direction: the sum over its half axes. The radius is the root mean square of two
        // perpendicular directions.
        double squares = 0;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 half = 0.5 * (local.hi[k] - local.lo[k]) * glm::dvec3(object.world[k]);
            squares += glm::dot(half, half) - std::pow(glm::dot(half, axis), 2);
        }
        const double radius = std::sqrt(squares / 2) * f.settings.blob.size;
        if (radius > 0 && radius <= widest * f.settings.blob.size)
            out.emplace_back(glm::vec3(middle - f.origin), float(radius));
    }
    return out;
}

void draw_light(const FrameState& f, const gl::Target& into, int light, PassInfo& info) {
    const FittedLight& fitted = f.gl.fitted[std::size_t(light)];
    const BlobSettings& blob = f.settings.blob;
    const auto framebuffer = gl::make_framebuffer("blobs", &into, nullptr, light);
    const glm::vec4 lit(1);
    glClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, 0, &lit.x);
    const std::vector<glm::vec4> casters = discs(f, fitted);
    if (casters.empty()) return;
    const gl::Buffer buffer = gl::make_buffer("casters of blobs", casters);
    const gl::VertexArray vao = gl::VertexArray::create("blobs");
    gl::enable_attribute(vao, 0, 0, 4);
    glVertexArrayBindingDivisor(vao.id(), 0, 1);
    glVertexArrayVertexBuffer(vao.id(), 0, buffer.id(), 0, sizeof(glm::vec4));

    f.begin_fullscreen_pass(framebuffer.id(), f.request.width, f.request.height);
    glBindVertexArray(vao.id());
    const GLuint id =
        f.program("passes/blob.vert.glsl", "passes/blob.frag.glsl", {{"LIGHT_INDEX", std::to_string(light)}});
    glUseProgram(id);
    const float widest = std::ranges::max(casters, {}, &glm::vec4::w).w;
    const double endless = 2 * f.scene.bounds.radius();
    glUniform1f(glGetUniformLocation(id, "end_m"), float(blob.reach > 0 ? blob.reach * widest : endless));
    glUniform4f(glGetUniformLocation(id, "blob"), float(blob.softness), float(blob.opacity), float(blob.reach), 0);
    // Only back faces are drawn: each pixel once, even with the camera inside.
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    glFrontFace(GL_CCW);
    glEnable(GL_DEPTH_CLAMP);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    glDrawArraysInstanced(GL_TRIANGLES, 0, 36, GLsizei(casters.size()));
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_CLAMP);
    glDisable(GL_CULL_FACE);
    ++info.draws;
    info.triangles += 12 * casters.size();
}

}  // namespace

void BlobPass::declare(FrameState& f) {
    std::vector<int> lights;
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i)
        if (f.gl.fitted[i].shadowed && source_of(f.settings, int(i)).needs.blobs) lights.push_back(int(i));
    if (lights.empty()) {
        f.plan.release_later([this] { lit_ = {}; });
        return;
    }
    f.plan.place_result(Result::Blobs, {&lit_, shared::UNIT_BLOBS});
    Key key = f.with_settings(f.lighting_key(), ReadBy::Blobs);
    for (const int light : lights) key.add(light);
    const auto run = [this, &f, lights](PassInfo& info) {
        lit_.ensure("blobs", GL_R16F, f.request.width, f.request.height, int(f.gl.fitted.size()));
        for (const int light : lights) draw_light(f, lit_, light, info);
    };
    f.plan.add_pass({.name = "blobs",
                     .category = PassCategory::Maps,
                     .reads = {Result::VisibleSurfaces},
                     .writes = {Result::Blobs},
                     .key = key.value(),
                     .cached = &lit_.key,
                     .run = run,
                     .idle_reason = "no pass reads visibility"});
}

}  // namespace si
