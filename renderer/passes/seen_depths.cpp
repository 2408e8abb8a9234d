// Measurement of the visible depth range. Lauritzen, Salvi, Lefohn, Sample Distribution Shadow Maps, I3D 2011, reduce
// the depth buffer likewise before they place cascades. Here the CPU finds least and greatest depth, and the frame
// waits for the read-back.
#include "renderer/passes/seen_depths.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "renderer/base/lengths_text.h"
#include "renderer/passes/camera_pass.h"

namespace si {
namespace {

// Padding of the range as a share of depth, for rounding of stored and looked-up depths in single precision.
constexpr double kSlack = 1e-5;

}  // namespace

std::optional<DepthSpan> measure_visible_depths(FrameState& f, PassInfo& info) {
    info = {.name = "visible depths", .state = PassState::Drawn, .category = PassCategory::Maps};
    const gl::DebugGroup group(info.name);
    const auto start = std::chrono::steady_clock::now();
    const CameraPass pass(f);  // read below by its bound framebuffer
    pass.draw("passes/camera_depth.frag.glsl", {}, info);
    std::vector<float> depths(std::size_t(f.request.width) * std::size_t(f.request.height));
    gl::prepare_read_back();
    glReadPixels(0, 0, f.request.width, f.request.height, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
    const DepthCurve& curve = f.camera.curve;
    const auto empty = float(curve.convention.far_depth());
    float least = 2, greatest = -1;
    for (const float depth : depths) {
        if (depth == empty) continue;
        least = std::min(least, depth);
        greatest = std::max(greatest, depth);
    }
    std::optional<DepthSpan> span;
    if (least <= greatest) {
        const double a = curve.distance(least), b = curve.distance(greatest);
        const double slack = kSlack * std::max(std::abs(a), std::abs(b));
        span = {std::min(a, b) - slack, std::max(a, b) + slack};
    }
    info.reason = span ? fmt::format("visible depths {} to {}, for light.depth_bounds", metres_text(span->from_m),
                                     metres_text(span->to_m))
                       : "no surface is visible: light.depth_bounds has no depths to use";
    if (f.request.timing) {
        info.cpu_ms = info.gpu_ms =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }
    return span;
}

}  // namespace si
