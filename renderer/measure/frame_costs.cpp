#include "renderer/measure/frame_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <vector>

#include "renderer/base/error.h"
#include "renderer/view/cameras/make_camera.h"

namespace si {
namespace {

constexpr CostRow kCosts[] = {
    {"forced", "everything drawn again", "with everything drawn again",
     "Every pass runs in every frame, as without any cache: the cost of a cold frame."},
    {"camera", "the camera moves", "while the camera moves",
     "The camera turns about its target by half a degree a frame, there and back. Results that do not depend on it, "
     "such as the map of a static light, are cached and cost nothing."},
    {"light", "the light moves", "while the light moves",
     "The light of view.light sinks by half a degree a frame, there and back. Results that do not depend on it, such "
     "as the camera's depth, are cached and cost nothing."},
};
static_assert(std::size(kCosts) == std::size_t(CostCase::Light) + 1);

/// Steps from the start; consecutive frames differ.
constexpr int kSwing[] = {0, 1, 2, 1};

}  // namespace

std::span<const CostRow> cost_cases() {
    return kCosts;
}

const CostRow& cost_row(CostCase cost) {
    return kCosts[std::size_t(cost)];
}

std::string cost_keys() {
    std::vector<std::string_view> keys;
    for (const CostRow& row : kCosts) keys.push_back(row.key);
    return fmt::format("{}", fmt::join(keys, ", "));
}

CostCase parse_cost(std::string_view key) {
    const auto row = std::ranges::find(kCosts, key, &CostRow::key);
    if (row == std::end(kCosts)) throw Error(fmt::format("cost {}: it is one of {}", key, cost_keys()));
    return CostCase(row - std::begin(kCosts));
}

std::vector<Settings> scripted_frames(const Scene& scene, const Settings& settings, double aspect, CostCase cost) {
    if (cost == CostCase::Forced) return {settings};
    std::vector<Settings> frames;
    Settings start = settings;
    // Explicit camera settings can be turned, and stay fixed while a light moves.
    if (cost == CostCase::Camera || settings.camera.source == CameraSource::Light)
        start.camera = manual_camera(scene, settings, aspect);
    const auto light = std::size_t(settings.view.light_index());
    for (const int steps : kSwing) {
        Settings s = start;
        const double turn = kCostStepDegrees * steps;
        LightSettings& l = s.lights[light];
        if (cost == CostCase::Camera)
            s.camera.azimuth = std::remainder(s.camera.azimuth + turn, 360.0);
        else
            l.elevation += l.elevation > 0 ? -turn : turn;
        frames.push_back(std::move(s));
    }
    return frames;
}

void set_timed_passes(FrameRequest& request, CostCase cost) {
    request.timing = true;
    request.force = cost == CostCase::Forced;
}

}  // namespace si
