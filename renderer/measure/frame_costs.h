// Cases for which the cost of a frame is timed: everything drawn again, the camera moves, the light moves. In the last
// two, cached results cost nothing, as in a program that caches them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/frame/frame.h"

namespace si {

/// Kind of frames that are timed. Forced: every pass is drawn again. Camera, Light: the camera or the light moves, and
/// unchanged passes are cached. Ordered as cost_cases().
enum class CostCase { Forced, Camera, Light };

/// Kind of frames that are timed by default: the camera moves, and unchanged passes are cached.
inline constexpr CostCase kDefaultCost = CostCase::Camera;

/// Row of the table of cost cases (CostCase): key, label and help of one kind of frames that are timed.
struct CostRow {
    std::string_view key, label;
    std::string_view when;  ///< text after "ms a frame", such as "while the camera moves"
    std::string_view help;
};
/// Returns the table of cost cases, the kinds of frames that are timed: everything drawn again, moving camera, moving
/// light.
std::span<const CostRow> cost_cases();
/// Returns the table row (key, label, help) of a cost case, the kind of frames that are timed.
const CostRow& cost_row(CostCase cost);
/// Returns the keys of all cost cases (kinds of frames that are timed) as a list for messages and help: "forced,
/// camera, light". "forced" draws everything again.
std::string cost_keys();
/// Returns the cost case (kind of frames that are timed) with a key such as "camera". @throws Error naming the known
/// keys
CostCase parse_cost(std::string_view key);

/// Turn of camera or light from one timed frame to the next, degrees.
inline constexpr double kCostStepDegrees = 0.5;

/// Returns the settings of the frames to time, one entry per frame, to be drawn in a loop. CostCase::Forced: one entry,
/// the given settings; nothing moves. CostCase::Camera: the camera turns about its target and back. CostCase::Light:
/// the light that view.light selects sinks and rises again; below the horizon it rises first. A camera that looks
/// through the light stays in place.
/// @param aspect width / height of the picture
std::vector<Settings> scripted_frames(const Scene& scene, const Settings& settings, double aspect, CostCase cost);

/// Prepares a frame request for timing: passes are timed, and CostCase::Forced draws every pass again instead of using
/// caches.
void set_timed_passes(FrameRequest& request, CostCase cost);

}  // namespace si
