#include "renderer/measure/shimmer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "renderer/base/error.h"

namespace si {
namespace {

constexpr ShimmerMotionRow kMotions[] = {
    {ShimmerMotion::CameraMoves, "camera", "The camera moves",
     "Sideways and up, along a line that lies on no grid; maps that do not follow the camera stay as they are."},
    {ShimmerMotion::CameraTurns, "turn", "The camera turns",
     "About its vertical axis, at a fixed position; a map's size and position may follow the view frustum."},
    {ShimmerMotion::LightTurns, "light", "The light turns",
     "About the vertical: shadows of the reference move too, so that some flips are right. Compare settings with each "
     "other."},
};

/// Length of one step: shift or turn of camera and light.
struct Stride {
    double metres = 0, camera_rad = 0, light_deg = 0;
};

Stride stride_of(const FrameResult& frame, const Scene& scene, const FittedLight& light, double step_texels) {
    const LightView& view = light.views.front();
    const glm::dvec3 centre = scene.bounds.centre();
    const double metres = step_texels * view.texel_size_at(centre, frame.map_size).longest;
    const double reach = std::max(scene.bounds.radius(), metres);
    return {metres, metres / std::max(frame.camera.focus, metres), metres / reach * 180 / std::numbers::pi};
}

Camera moved(Camera camera, const ShimmerOptions& options, const Stride& stride, int step) {
    if (options.motion == ShimmerMotion::CameraMoves)
        camera.eye += (0.8 * camera.axes[0] + 0.6 * camera.axes[1]) * (stride.metres * step);
    if (options.motion == ShimmerMotion::CameraTurns) {
        const glm::dmat3 turn(glm::rotate(glm::dmat4(1), stride.camera_rad * step, glm::dvec3(0, 1, 0)));
        camera.axes = turn * camera.axes;
    }
    return camera;
}

}  // namespace

std::span<const ShimmerMotionRow> shimmer_motions() {
    return kMotions;
}

Shimmer measure_shimmer(Renderer& renderer, const Scene& scene, const Settings& settings, int width, int height,
                        const ShimmerOptions& options, const Workers& workers,
                        const std::function<void(double)>& report) {
    FrameRequest request{.width = width, .height = height};
    request.outputs = {.colour = false, .visibility = true, .surface_ids = true};
    const FrameResult first = renderer.render(scene, settings, request);
    const auto light = std::size_t(std::max(settings.view.light, 0));
    if (light >= first.lights.size() || !first.lights[light].casts || first.lights[light].views.empty())
        throw Error(fmt::format("light {} has no shadow map, so nothing can shimmer: choose another by view.light",
                                settings.view.light));
    const Stride stride = stride_of(first, scene, first.lights[light], options.step_texels);
    const SurfaceIds ids = renderer.read_surface_ids(first.surface_ids);
    Shimmer out;
    out.flips_of = {width, height, 1, std::vector<float>(ids.data.size(), 0.f)};
    for (const glm::uvec2& id : ids.data) out.places += id.x != 0;
    request.outputs.surface_ids = false;
    FloatImage before;
    double change = 0;
    for (int step = 0; step <= options.steps; ++step) {
        if (workers.stop.stop_requested()) throw Cancelled();
        Settings now = settings;
        if (options.motion == ShimmerMotion::LightTurns)
            now.lights[light].azimuth = std::remainder(now.lights[light].azimuth + stride.light_deg * step, 360);
        else
            request.map_camera = MapCamera{moved(first.camera, options, stride, step), first.seen_m};
        FloatImage visibility = renderer.read_float(renderer.render(scene, now, request).visibility, 1);
        if (step > 0) {
            std::size_t flips = 0;
            for (std::size_t i = 0; i < visibility.data.size(); ++i) {
                if (ids.data[i].x == 0) continue;
                change += std::abs(double(visibility.data[i]) - double(before.data[i]));
                if ((visibility.data[i] < 0.5f) == (before.data[i] < 0.5f)) continue;
                ++flips;
                out.flips_of.data[i] += 1;
            }
            out.flips.push_back(flips);
            out.max_flips = std::max(out.max_flips, flips);
            out.flips_a_step += double(flips) / options.steps;
        }
        before = std::move(visibility);
        if (report) report(double(step + 1) / (options.steps + 1));
    }
    out.flipping_pixels = std::size_t(
        std::count_if(out.flips_of.data.begin(), out.flips_of.data.end(), [](float flips) { return flips > 0; }));
    if (out.places > 0) out.change = change / double(out.places) / options.steps;
    return out;
}

std::vector<ShimmerVariant> shimmer_variants(const Settings& settings) {
    std::vector<ShimmerVariant> out{{"as-set", "As set", settings}};
    const auto light = std::size_t(settings.view.light_index());
    if (settings.lights[light].type != LightType::Directional) return out;  // only maps of suns follow the camera
    for (const bool snap : {true, false}) {
        Settings s = settings;
        s.lights[light].fit = LightFit::Stabilised;
        s.lights[light].snap = snap;
        out.push_back({snap ? "snapped" : "unsnapped", snap ? "Stabilised, whole texels" : "Stabilised, unsnapped", s});
    }
    return out;
}

}  // namespace si
