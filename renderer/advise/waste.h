// Wasted work of a frame: each map, cube face, cascade and effect is left out in turn. Work that changes no byte of the
// picture is waste.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/advise/trial.h"

namespace si {

/// Trial of leaving out one piece of a frame's work, such as a cascade, and whether the picture then changes.
struct WasteTrial {
    std::string name;             ///< "cascade 2 of 4 of light 0"
    bool changes = false;         ///< the picture changes; false: waste
    double read = -1;             ///< share of texels that visible pixels' kernels read; negative: not a map
    std::uint64_t triangles = 0;  ///< triangles that the work draws into maps
    double maps_ms = 0;           ///< time of the maps that leaving out the work saves, milliseconds; 0: not timed
    /// Returns true for a map without triangles whose texels the picture does not need.
    bool is_undrawn() const { return read >= 0 && triangles == 0 && !changes; }
    /// Returns the verdict on the work: "needed", "not drawn" or "waste".
    std::string_view verdict() const { return changes ? "needed" : is_undrawn() ? "not drawn" : "waste"; }
    /// Returns the name of the work that was left out and, for a map, the share of its texels that the picture reads.
    std::string text() const;
};

/// Result of find_waste(): trials that leave out each piece of a frame's work, with sums over work that changes
/// nothing.
struct Waste {
    std::vector<WasteTrial> tried;
    std::optional<double> maps_ms;  ///< time of all maps, milliseconds; none: not timed
    bool stopped = false;           ///< stopped before all work was left out once
    /// Returns the number of triangles that the frame draws into shadow maps.
    std::uint64_t triangles() const;
    /// Returns the number of triangles that the frame draws into shadow maps without changing the picture.
    std::uint64_t wasted() const;
    /// Returns the time that drawing shadow maps takes without changing the picture, milliseconds. 0 if not timed.
    double wasted_ms() const;
    /// Returns the wasted share of the triangles drawn into maps, 0 to 1.
    double share() const { return triangles() ? double(wasted()) / double(triangles()) : 0; }
    /// Returns the share of the shadow maps' time, 0 to 1, that is spent on maps without changing the picture; none:
    /// not timed, or no time.
    std::optional<double> share_of_time() const;
    /// Returns a text on work that does not change the picture: a line with its share of the triangles and, if timed, a
    /// line with its share of the shadow maps' time.
    std::string summary() const;
};

/// Searches for wasted work in a frame: leaves out each map, cube face, cascade and effect in turn, and compares the
/// picture with that of the whole frame. Virtual maps are tested per light.
/// @param request input of the frame; with `timing`, frames with and without wasted work are timed alternately
/// @param shown receives the trials so far, after each trial
/// @throws Error; Cancelled before the first trial. Later the trials so far are returned
Waste find_waste(const SearchTools& tools, const Settings& settings, FrameRequest request,
                 const std::function<void(const Waste&)>& shown = {});

}  // namespace si
