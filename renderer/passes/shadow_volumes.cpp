#include "renderer/passes/shadow_volumes.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/gl/driver_failure.h"
#include "renderer/passes/casters.h"
#include "renderer/settings/sources.h"

namespace si {
namespace {

constexpr GLuint kCornerBinding = 0, kTransformBinding = 3;
constexpr std::size_t kMaxSampledTriangles = 4000;  ///< triangles sampled for a cost estimate

VolumeLight volume_light(const FittedLight& light) {
    return {light.type == LightType::Directional, light.to_light, light.position};
}

/// Distance of finite volume ends: multiple of the scene's radius, or of a caster corner's distance from the light.
constexpr double kFarDistanceFactor = 1e4;

/// Returns true when volumes end at a finite distance. An orthographic camera sees no infinitely far point, and volumes
/// along its axis would have no end.
bool ends_are_finite(const FrameState& f) {
    return f.camera.orthographic;
}

double reach_m(const FrameState& f) {
    return kFarDistanceFactor * std::max(f.scene.bounds.radius(), 1e-30);
}

/// Returns true when a caster may lie beyond the camera's far plane.
bool reaches_beyond_far(const FrameState& f) {
    const glm::dmat4 clip = f.camera.clip_from_relative(f.origin);
    return std::ranges::any_of(f.scene.bounds.corners(), [&](const glm::dvec3& corner) {
        return (clip * glm::dvec4(corner - f.origin, 1)).z <= 0;  // reversed: 0 is far
    });
}

}  // namespace

void ShadowVolumes::reset_volume_meshes(const FrameState& f) {
    if (scene_ == f.scene.id) return;
    scene_ = f.scene.id;
    corners_uploaded_ = false;
    meshes_.clear();
    meshes_.resize(f.scene.meshes.size());
    for (Light& light : lights_) light.shape = 0;
}

void ShadowVolumes::build_volume_triangles(const FrameState& f, std::size_t number, const VolumeLight& source) {
    Light& light = lights_[number];
    light.parts.clear();
    light.indices.clear();
    light.open_triangles = 0;
    const std::vector<std::uint32_t>& objects = f.gl.scene->instance_objects();
    VolumeTriangles found;
    for (std::uint32_t instance = 0; instance < objects.size(); ++instance) {
        const Object& object = f.scene.objects[objects[instance]];
        if (!can_cast(f.scene, f.settings, object)) continue;
        auto& mesh = meshes_[std::size_t(object.mesh)];
        if (!mesh) {
            mesh = std::make_unique<VolumeMesh>(f.scene.meshes[std::size_t(object.mesh)]);
            corners_uploaded_ = false;
        }
        found = {};
        add_shadow_volume(*mesh, object.world, source, !source.parallel || ends_are_finite(f), found);
        light.open_triangles += mesh->open_triangles;
        Part part{.instance = instance, .mesh = std::uint32_t(object.mesh)};
        std::size_t list = 0;
        for (const auto* indices : {&found.caps, &found.clockwise_caps, &found.rest}) {
            part.first[list++] = light.indices.size();
            light.indices.insert(light.indices.end(), indices->begin(), indices->end());
        }
        part.first[list] = light.indices.size();
        if (part.first[list] > part.first[0]) light.parts.push_back(part);
    }
    light.index_count = light.indices.size();
}

std::string ShadowVolumes::describe_cost(const FrameState& f, const Light& light, const VolumeLight& source) const {
    const glm::dmat4 clip = f.camera.clip_from_relative(f.origin);
    double pixels = 0;
    const std::size_t samples =
        std::max<std::size_t>(kMaxSampledTriangles / std::max<std::size_t>(light.parts.size(), 1), 1);
    const std::size_t every = std::max<std::size_t>(light.parts.size() / kMaxSampledTriangles, 1);
    std::size_t looked_at = 0;
    for (std::size_t p = 0; p < light.parts.size(); p += every, ++looked_at) {
        const Part& part = light.parts[p];
        const VolumeMesh& mesh = *meshes_[part.mesh];
        const Object& object = f.scene.objects[f.gl.scene->instance_objects()[part.instance]];
        const auto corner = [&](std::uint32_t v) {
            const glm::dvec3 at(object.world * glm::dvec4(glm::dvec3(mesh.positions[v / 2]), 1));
            if (v % 2 == 0) return clip * glm::dvec4(at - f.origin, 1);
            const glm::dvec3 away = source.parallel ? -source.to_light : at - source.position_ws;
            if (!ends_are_finite(f)) return clip * glm::dvec4(away, 0);
            return clip * glm::dvec4(at - f.origin + away * (source.parallel ? reach_m(f) : kFarDistanceFactor), 1);
        };
        const std::vector<std::uint32_t> list(light.indices.begin() + std::ptrdiff_t(part.first[0]),
                                              light.indices.begin() + std::ptrdiff_t(part.first[3]));
        pixels += covered_pixels(list, corner, f.request.width, f.request.height, samples);
    }
    if (looked_at > 0) pixels *= double(light.parts.size()) / double(looked_at);
    return fmt::format("{} triangles that cover the picture about {:.0f} times", light.index_count / 3,
                       pixels / (double(f.request.width) * f.request.height));
}

void ShadowVolumes::prepare(const FrameState& f) {
    const std::vector<FittedLight>& fitted = f.gl.fitted;
    reset_volume_meshes(f);
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        Light& light = lights_[i];
        light.used = i < fitted.size() && fitted[i].shadowed && source_of(f.settings, int(i)).needs.stencil;
        light.refusal.clear();
        if (!light.used) continue;
        light.before = source_of(f.settings, int(i)).needs.counts_front_faces;
        const VolumeLight source = volume_light(fitted[i]);
        Key shape = f.geometry_key;
        shape.add(ends_are_finite(f)).add(source.parallel).add(source.parallel ? source.to_light : source.position_ws);
        if (light.shape != shape.value()) {
            build_volume_triangles(f, i, source);
            light.shape = shape.value();
        }
        if (light.open_triangles > kMaxOpenTriangles && !f.settings.volumes.allow_large)
            light.refusal = fmt::format(
                "light {}: shadow volumes are not drawn: {} triangles of its casters, more than {}, do not belong to "
                "closed surfaces: {}; volumes.allow_large draws them anyway",
                i, light.open_triangles, kMaxOpenTriangles, describe_cost(f, light, source));
    }
}

void ShadowVolumes::release_unused() {
    for (Light& light : lights_)
        if (!light.used) light = {};
}

void ShadowVolumes::upload_corners() {
    if (corners_uploaded_) return;
    std::vector<glm::vec4> corners;
    first_corner_.assign(meshes_.size(), 0);
    for (std::size_t m = 0; m < meshes_.size(); ++m) {
        if (!meshes_[m]) continue;
        first_corner_[m] = std::uint32_t(corners.size());
        for (const glm::vec3& p : meshes_[m]->positions)
            for (const float far : {0.f, 1.f}) corners.emplace_back(p, far);
    }
    corners_ = gl::make_buffer("corners of shadow volumes", corners);
    vao_ = gl::VertexArray::create("shadow volumes");
    gl::enable_attribute(vao_, 0, kCornerBinding, 4);
    glVertexArrayVertexBuffer(vao_.id(), kCornerBinding, corners_.id(), 0, sizeof(glm::vec4));
    corners_uploaded_ = true;
}

void ShadowVolumes::copy_depth(const FrameState& f, PassInfo& info) {
    const int width = f.request.width, height = f.request.height;
    if (depth_stencil_.ensure("depth and stencil of shadow volumes", GL_DEPTH32F_STENCIL8, width, height) ||
        !counting_) {
        counting_ = gl::make_framebuffer("shadow volumes", nullptr, &depth_stencil_);
        glNamedFramebufferTexture(counting_.id(), GL_STENCIL_ATTACHMENT, depth_stencil_.texture.id(), 0);
        depth_copied_ = 0;
    }
    if (depth_copied_ == f.surfaces_key().value() && !f.request.force) return;
    f.begin_fullscreen_pass(counting_.id(), width, height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDepthMask(GL_TRUE);
    f.use_fullscreen("passes/volume_depth.frag.glsl");
    FrameState::draw_fullscreen(info);
    depth_copied_ = f.surfaces_key().value();
}

void ShadowVolumes::draw_faces(const Light& light, int first, int last, PassInfo& info) const {
    for (const Part& part : light.parts) {
        const std::size_t from = part.first[std::size_t(first)], to = part.first[std::size_t(last) + 1];
        if (from == to) continue;
        glDrawElementsInstancedBaseVertexBaseInstance(GL_TRIANGLES, GLsizei(to - from), GL_UNSIGNED_INT,
                                                      reinterpret_cast<const void*>(from * sizeof(std::uint32_t)), 1,
                                                      GLint(first_corner_[part.mesh]), part.instance);
        ++info.draws;
        info.triangles += (to - from) / 3;
    }
}

void ShadowVolumes::count_volumes(const FrameState& f, std::size_t number, PassInfo& info) {
    Light& light = lights_[number];
    upload_corners();
    if (light.uploaded != light.shape) {
        light.buffer = gl::make_buffer("triangles of shadow volumes", light.indices);
        light.uploaded = light.shape;
    }
    f.gl.scene->bind_vertices(f.scene, f.settings, f.origin, SceneGpu::Drawn::Volumes);
    f.gl.scene->bind_transforms(vao_, kTransformBinding, SceneGpu::Drawn::Volumes);
    glVertexArrayElementBuffer(vao_.id(), light.buffer.id());
    glBindVertexArray(vao_.id());

    glBindFramebuffer(GL_FRAMEBUFFER, counting_.id());
    glViewport(0, 0, f.request.width, f.request.height);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    const GLint none = 0;
    glStencilMask(~0u);
    glClearNamedFramebufferiv(counting_.id(), GL_STENCIL, 0, &none);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    // Equal depth counts as behind: see the class.
    glDepthFunc(f.camera.curve.convention.reversed ? GL_GREATER : GL_LESS);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, 0, ~0u);
    const GLenum front = light.before ? GL_INCR_WRAP : GL_DECR_WRAP, back = light.before ? GL_DECR_WRAP : GL_INCR_WRAP;
    glStencilOpSeparate(GL_FRONT, GL_KEEP, light.before ? GL_KEEP : front, light.before ? front : GL_KEEP);
    glStencilOpSeparate(GL_BACK, GL_KEEP, light.before ? GL_KEEP : back, light.before ? back : GL_KEEP);
    const double reach = !ends_are_finite(f)                          ? 0
                         : volume_light(f.gl.fitted[number]).parallel ? reach_m(f)
                                                                      : kFarDistanceFactor;
    const auto use = [&](const char* sides, const char* beyond) {
        const GLuint id = f.program("passes/volume.vert.glsl", "passes/volume.frag.glsl",
                                    {{"LIGHT_INDEX", std::to_string(number)},
                                     {"VOLUME_SIDES", sides},
                                     {"VOLUME_FINITE", ends_are_finite(f) ? "1" : "0"},
                                     {"VOLUME_BEYOND_FAR", beyond}});
        glUseProgram(id);
        if (ends_are_finite(f)) glUniform1f(glGetUniformLocation(id, "reach"), float(reach));
    };
    const auto draw_caps = [&] {
        glFrontFace(GL_CCW);
        draw_faces(light, 0, 0, info);
        glFrontFace(GL_CW);
        draw_faces(light, 1, 1, info);
        glFrontFace(GL_CCW);
    };
    if (!light.before) {  // a cap never lies in front of its own surface
        use("0", "0");
        draw_caps();  // clipped as in camera passes, so that depths are equal
        glEnable(GL_DEPTH_CLAMP);
        if (reaches_beyond_far(f)) {
            use("0", "1");
            glEnable(GL_CLIP_DISTANCE0);
            draw_caps();
            glDisable(GL_CLIP_DISTANCE0);
        }
    }
    use("1", "0");
    draw_faces(light, 2, 2, info);
    glDisable(GL_DEPTH_CLAMP);

    marking_ = gl::make_framebuffer("lit outside of shadow volumes", &lit_, &depth_stencil_, int(number));
    glNamedFramebufferTexture(marking_.id(), GL_STENCIL_ATTACHMENT, depth_stencil_.texture.id(), 0);
    const glm::vec4 dark(0);
    glClearNamedFramebufferfv(marking_.id(), GL_COLOR, 0, &dark.x);
    f.begin_fullscreen_pass(marking_.id(), f.request.width, f.request.height);
    glStencilFunc(GL_EQUAL, 0, ~0u);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    f.use_fullscreen("passes/volume_lit.frag.glsl");
    FrameState::draw_fullscreen(info);
    glDisable(GL_STENCIL_TEST);
    glDepthMask(GL_TRUE);
}

Pass ShadowVolumes::make_pass(FrameState& f, std::size_t number) {
    Light& light = lights_[number];
    Pass pass{.name = fmt::format("shadow volumes {}", number),
              .category = PassCategory::Maps,
              .light = int(number),
              .reads = {Result::CameraDepth},
              .writes = {Result::ShadowVolumes},
              .unneeded = light.refusal,
              .idle_reason = "no pass reads visibility"};
    if (!light.refusal.empty()) return pass;
    const int layers = int(f.gl.fitted.size());
    pass.key = f.surfaces_key().add(layers).add(light.shape).add(light.before).value();
    pass.cached = &light.drawn;
    pass.run = [this, &f, number, layers](PassInfo& info) {
        if (lit_.ensure("lit outside of shadow volumes", GL_R8, f.request.width, f.request.height, layers))
            for (Light& l : lights_) l.drawn = 0;
        copy_depth(f, info);
        count_volumes(f, number, info);
        const Light& l = lights_[number];
        info.reason += fmt::format("; {} triangles; {} casters' triangles without a closed surface", l.index_count / 3,
                                   l.open_triangles);
    };
    return pass;
}

void ShadowVolumePasses::declare(FrameState& f) {
    bool any = false;
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i)
        any |= f.gl.fitted[i].shadowed && source_of(f.settings, int(i)).needs.stencil;
    if (!any) {
        f.plan.release_later([this] { volumes_ = {}; });
        return;
    }
    volumes_.prepare(f);
    f.plan.place_result(Result::ShadowVolumes, {&volumes_.lit(), shared::UNIT_VOLUMES});
    f.plan.release_later([this] { volumes_.release_unused(); });
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i) {
        if (!f.gl.fitted[i].shadowed || !source_of(f.settings, int(i)).needs.stencil) continue;
        f.plan.add_pass(volumes_.make_pass(f, i));
        if (!volumes_.refusal(i).empty()) f.notes.push_back(volumes_.refusal(i));
    }
}

}  // namespace si
