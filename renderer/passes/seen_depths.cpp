// Between which depths the camera sees anything. Lauritzen, Salvi, Lefohn, Sample Distribution Shadow Maps, I3D 2011,
// reduce the depth buffer likewise before they divide it among cascades; here the least and the greatest of its values
// are found on the CPU, for which the frame waits.
#include "renderer/passes/seen_depths.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "renderer/base/lengths_text.h"
#include "renderer/passes/camera_pass.h"

namespace si {
namespace {

// Of the depth: what single precision loses of it, and of the depth that a look-up computes from a position.
constexpr double kSlack = 1e-5;

}  // namespace

std::optional<DepthSpan> measure_seen_depths(FrameState& f, PassInfo& info) {
    info = {.name = "visible depths", .state = PassState::Drawn, .category = PassCategory::Maps};
    const gl::DebugGroup group(info.name);
    const auto start = std::chrono::steady_clock::now();
    const CameraPass pass(f);  // whose framebuffer is read below
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
