// What a frame costs has three answers: all of it drawn anew; while the camera moves; while the light moves. What is
// kept from one frame to the next costs nothing in the latter two, as it does in a program that keeps it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/frame/frame.h"

namespace si {

/// In the order of cost_cases().
enum class CostCase { Forced, Camera, Light };

/// What figures are of where nobody chooses.
inline constexpr CostCase kDefaultCost = CostCase::Camera;

struct CostRow {
    std::string_view key, label;
    std::string_view when;  ///< "while the camera moves", after "ms a frame"
    std::string_view help;
};
std::span<const CostRow> cost_cases();
const CostRow& row_of(CostCase cost);
/// "forced, camera, light", for messages and help.
std::string cost_keys();
/// @throws Error naming the known keys
CostCase parse_cost(std::string_view key);

/// How far camera or light turn from one frame to the next, degrees.
inline constexpr double kCostStepDegrees = 0.5;

/// The settings of the frames of a scripted motion that comes back to its start: frame i takes the i-th, modulo their
/// number. The camera is turned about its target; the light of view.light is lowered (raised, from below the horizon),
/// which moves one that stands at the zenith, too, and the camera that looks through it is left where it was.
/// @param aspect of the picture, width / height
std::vector<Settings> scripted_frames(const Scene& scene, const Settings& settings, double aspect, CostCase cost);

/// Turns `request` into one that is timed as the case says.
void set_timed_passes(FrameRequest& request, CostCase cost);

}  // namespace si
