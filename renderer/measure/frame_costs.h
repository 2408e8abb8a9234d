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

/// Kind of frames that are timed by default.
inline constexpr CostCase kDefaultCost = CostCase::Camera;

/// Row of the table of cost cases: key, label and help of one kind of timed frames (CostCase).
struct CostRow {
    std::string_view key, label;
    std::string_view when;  ///< "while the camera moves", after "ms a frame"
    std::string_view help;
};
/// Returns the table of kinds of timed frames: every pass drawn, moving camera, moving light.
std::span<const CostRow> cost_cases();
/// Returns the table row of one kind of timed frames.
const CostRow& cost_row(CostCase cost);
/// Returns the keys of all kinds of timed frames for messages and help: "forced, camera, light".
std::string cost_keys();
/// Returns the kind of timed frames with this key. @throws Error naming the known keys
CostCase parse_cost(std::string_view key);

/// Turn of camera or light from one timed frame to the next, degrees.
inline constexpr double kCostStepDegrees = 0.5;

/// Returns the settings of the frames that are timed, one entry a frame, to be repeated in a loop. Forced: the given
/// settings alone. Camera: the camera turns about its target and back. Light: the light of view.light sinks and comes
/// back (rises first if it is below the horizon); a camera that looks through the light stays in place.
/// @param aspect width / height of the picture
std::vector<Settings> scripted_frames(const Scene& scene, const Settings& settings, double aspect, CostCase cost);

/// Sets a frame request to time its passes under a cost case: CostCase::Forced draws every pass again.
void set_timed_passes(FrameRequest& request, CostCase cost);

}  // namespace si
