// Images of the visible surfaces. The camera depth is drawn by the first pass from the camera, or by its own pass where
// only the map viewer or texel quads read it.
//
// Lauritzen, Salvi, Lefohn, Sample Distribution Shadow Maps, I3D 2011, reduce the depth buffer before they place
// cascades, as measure_visible_depths() does. Here the CPU finds least and greatest depth, and the frame waits for the
// read-back.
#include "renderer/passes/camera_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "renderer/base/lengths_text.h"
#include "renderer/passes/camera_drawing.h"
#include "renderer/settings/biases.h"
#include "renderer/view/culling/box_culling.h"

namespace si {
namespace {

// Padding of the range as a share of depth, for rounding of stored and looked-up depths in single precision.
constexpr double kSlack = 1e-5;

/// Returns the camera depth image, resized to the picture. Its key is cleared once a frame if the request forces a
/// redraw.
gl::Target& camera_depth(FrameState& f) {
    gl::Target& depth = f.gl.camera_depth;
    depth.ensure("camera depth", GL_DEPTH_COMPONENT32F, f.request.width, f.request.height);
    if (f.request.force && !f.camera_depth_renewed) depth.key = 0;
    f.camera_depth_renewed = true;
    return depth;
}

/// Widens an interval of depths so that it contains another. @param span nullopt: no depths yet
void widen(std::optional<DepthSpan>& span, const DepthSpan& by) {
    span = span ? DepthSpan{std::min(span->from_m, by.from_m), std::max(span->to_m, by.to_m)} : by;
}

/// Returns the depths of the boxes of blended objects that the camera may see, metres along its axis; nullopt: none.
/// The depth image does not hold these objects.
std::optional<DepthSpan> depths_of_blended_boxes(const FrameState& f) {
    const SceneGpu& gpu = *f.gl.scene;
    const BoxCuller culler(f.camera.clip_from_relative(f.origin), f.origin, f.camera.curve.convention, false,
                           std::min(f.request.width, f.request.height));
    std::optional<DepthSpan> span;
    for (std::size_t i = 0; i < gpu.instance_objects().size(); ++i) {
        if (!gpu.batches()[gpu.instance_batches()[i]].blend) continue;
        const Object& o = f.scene.objects[gpu.instance_objects()[i]];
        const SkewBox box(f.scene.meshes[std::size_t(o.mesh)].bounds, o.world);
        if (culler.is_outside(box)) continue;
        const double middle = glm::dot(f.camera.eye - box.centre, f.camera.axes[2]);
        double half = 0;
        for (int axis = 0; axis < 3; ++axis) half += std::abs(glm::dot(box.half[axis], f.camera.axes[2]));
        const double from = std::max(middle - half, f.camera.curve.near),
                     to = std::min(middle + half, f.camera.curve.far);
        if (from <= to) widen(span, {from, to});
    }
    return span;
}

}  // namespace

CameraDrawing::CameraDrawing(FrameState& f, std::string_view label, GLenum format, std::span<gl::Target> images)
    : f_(f), images_(GLint(images.size())) {
    for (gl::Target& image : images) image.ensure(label, format, f.request.width, f.request.height);
    const gl::Target& depth = camera_depth(f);
    framebuffer_ =
        images.empty() ? gl::make_framebuffer(label, nullptr, &depth) : gl::make_framebuffer(label, images, depth);
    begin();
}

CameraDrawing::CameraDrawing(FrameState& f, std::string_view label, const gl::Target& image, int layer)
    : f_(f), framebuffer_(gl::make_framebuffer(label, &image, &camera_depth(f), layer)) {
    begin();
}

void CameraDrawing::begin() {
    f_.begin_camera_pass(framebuffer_.id());
    gl::Target& depth = f_.gl.camera_depth;
    if (const std::uint64_t key = f_.surfaces_key().value(); depth.key != key) {
        const float far_depth = float(f_.camera.curve.convention.far_depth());
        glClearNamedFramebufferfv(framebuffer_.id(), GL_DEPTH, 0, &far_depth);
        depth.key = key;
    }
}

CameraDrawing& CameraDrawing::clear(const glm::vec4& value) {
    for (GLint i = 0; i < images_; ++i) glClearNamedFramebufferfv(framebuffer_.id(), GL_COLOR, i, &value.x);
    return *this;
}

CameraDrawing& CameraDrawing::clear(const glm::uvec4& value) {
    for (GLint i = 0; i < images_; ++i) glClearNamedFramebufferuiv(framebuffer_.id(), GL_COLOR, i, &value.x);
    return *this;
}

std::optional<DepthSpan> measure_visible_depths(FrameState& f, PassInfo& info) {
    info = {.name = "visible depths",
            .state = PassState::Drawn,
            .category = PassCategory::Maps,
            .makes = Result::VisibleDepths};
    const gl::DebugGroup group(info.name);
    const auto start = std::chrono::steady_clock::now();
    const CameraDrawing pass(f);  // read below by its bound framebuffer
    pass.draw("passes/camera_depth.frag.glsl", {}, info);
    std::vector<float> depths(std::size_t(f.request.width) * std::size_t(f.request.height));
    gl::prepare_read_back();
    glReadPixels(0, 0, f.request.width, f.request.height, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
    const DepthCurve& curve = f.camera.curve;
    std::erase(depths, float(curve.convention.far_depth()));
    std::optional<DepthSpan> span;
    if (!depths.empty()) {
        const auto [least, greatest] = std::ranges::minmax(depths);
        const double a = curve.distance(least), b = curve.distance(greatest);
        const double slack = kSlack * std::max(std::abs(a), std::abs(b));
        span = {std::min(a, b) - slack, std::max(a, b) + slack};
    }
    if (const std::optional<DepthSpan> blended = depths_of_blended_boxes(f)) widen(span, *blended);
    info.reason = span ? fmt::format("visible depths {} to {}, for light.depth_bounds", metres_text(span->from_m),
                                     metres_text(span->to_m))
                       : "no surface is visible: light.depth_bounds has no depths to use";
    const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
    if (f.request.timing) info.cpu_ms = spent.count();
    return span;
}

void CameraDepthPass::declare(FrameState& f) {
    gl::Target& depth = f.gl.camera_depth;
    f.plan.place_result(Result::CameraDepth, {&depth, shared::UNIT_CAMERA_DEPTH});
    f.plan.add_pass({.name = "camera depth",
                     .writes = {Result::CameraDepth},
                     .key = f.surfaces_key().value(),
                     .cached = &depth.key,
                     .run = [&f](PassInfo& info) { CameraDrawing(f).draw("passes/camera_depth.frag.glsl", {}, info); },
                     .idle_reason = "no pass reads it: each pass from the camera tests depth itself"});
}

void SurfaceIdsPass::declare(FrameState& f) {
    f.plan.place_result(Result::SurfaceIds, {&ids_});
    // The object's number is passed along with the surface flags.
    const auto run = [this, &f](PassInfo& info) {
        CameraDrawing(f, "surface ids", GL_RG32UI, ids_)
            .clear(glm::uvec4(0))
            .draw("passes/surface_ids.frag.glsl", {{"SURFACE_FLAGS", "1"}}, info);
    };
    f.plan.add_pass({.name = "surface ids",
                     .category = PassCategory::Tool,
                     .writes = {Result::SurfaceIds},
                     .key = f.surfaces_key().value(),
                     .cached = &ids_.key,
                     .run = run,
                     .idle_reason = "not needed: no pass reads triangle numbers"});
}

void VisibleSurfacesPass::declare(FrameState& f) {
    for (int i = 0; i < kVisibleSurfaceImages; ++i)
        f.plan.place_result(Result::VisibleSurfaces, {&images_[std::size_t(i)], shared::UNIT_SEEN_SURFACES + i});
    // The image of the shading normal exists even where the normal has no effect.
    const bool own_normal = f.settings.bias.normal_source != NormalSource::Geometric;
    const std::size_t count = bias_of(f.settings).by_derivatives ? 5 : own_normal ? 3 : 2;
    // The normal's source counts without effect, too: a change of the bias may give it an effect on the same images.
    Key surfaces = f.with_settings(f.surfaces_key(), ReadBy::SurfacesSeen);
    surfaces.add(f.settings.bias.normal_source);
    const auto key_of = [&](std::size_t images) { return Key(surfaces).add(images).value(); };
    // Images of the same surfaces that another bias has read contain those that this one reads.
    const bool has_more = !f.request.force && drawn_ > count && images_[0].key == key_of(drawn_);
    const auto run = [this, &f, count](PassInfo& info) {
        drawn_ = count;
        for (gl::Target& unused : std::span(images_).subspan(count)) unused = {};
        CameraDrawing(f, "visible surfaces", GL_RGBA32F, std::span(images_).first(count))
            .clear(glm::vec4(0))  // empty pixels receive no shadow
            .draw("passes/seen_surfaces.frag.glsl", {}, info);
    };
    f.plan.add_pass({.name = "visible surfaces",
                     .category = PassCategory::Tool,
                     .writes = {Result::VisibleSurfaces},
                     .key = key_of(has_more ? drawn_ : count),
                     .cached = &images_[0].key,
                     .run = run,
                     .idle_reason = "no pass evaluates pixels again"});
}

void MapCoordinatesPass::declare(FrameState& f) {
    f.plan.place_result(Result::MapCoordinates, {&coordinates_});
    Pass pass{.name = "map coordinates",
              .category = PassCategory::Tool,
              .writes = {Result::MapCoordinates},
              .idle_reason = "not needed: no output shows which texels are read"};
    if (!f.shown_view()) return f.plan.skip_pass(std::move(pass), "view.light has no shadow map");
    pass.key = f.shown_light_key().value();
    pass.cached = &coordinates_.key;
    pass.run = [this, &f](PassInfo& info) {
        CameraDrawing(f, "map coordinates", GL_RGBA32F, coordinates_)
            .clear(glm::vec4(0))
            .draw("passes/map_coordinates.frag.glsl", {{"LIGHT_INDEX", std::to_string(f.settings.view.light)}}, info);
    };
    f.plan.add_pass(std::move(pass));
}

void bind_visible_surfaces(std::span<const gl::Target, kVisibleSurfaceImages> seen) {
    for (std::size_t i = 0; i < seen.size(); ++i)
        glBindTextureUnit(GLuint(shared::UNIT_SEEN_SURFACES + i), seen[i].texture.id());
}

}  // namespace si
