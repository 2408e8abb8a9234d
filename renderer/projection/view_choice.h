// Which of a light's views a point is looked up in: shaders/lib/view_choice.glsl in double.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "renderer/projection/light_view.h"

namespace si {

/// One: the only view. Face: of six, by the largest coordinate from the light's place. Interval: by the camera's depth.
/// Map: the first whose map holds the point. Distance: by that from the camera.
enum class ViewChoice { One, Face, Interval, Map, Distance };

/// Where a view ends, and from where on the next one that holds a point is blended in. Interval: metres of camera
/// depth. Map: the larger distance from the map's centre, u or v, so that 0.5 is its side. Distance: metres.
struct ViewSpan {
    double ends = 0, blends_from = 0;
};

struct ChosenView {
    std::size_t view = 0;
    std::size_t other = 0;  ///< blended in by `share`; `view` itself where nothing is
    double share = 0;
};

struct ViewChooser {
    ViewChoice choice = ViewChoice::One;
    glm::dvec3 from_ws{0};        ///< Face: the light's place; Interval and Distance: the camera's
    glm::dvec3 forward{0};        ///< Interval: unit, the camera's viewing direction
    std::vector<ViewSpan> spans;  ///< of each view, but for One and Face
    /// The last view where none holds the point.
    /// @param views of the light; never empty
    ChosenView choose(std::span<const LightView> views, const glm::dvec3& point_ws) const;
};

/// A view's short name among its light's: "+x", "2".
std::string view_short_name(ViewChoice choice, std::size_t view);
/// "face +x", "cascade 2 of 4"; empty for a light's only view.
std::string view_name(ViewChoice choice, std::size_t view, std::size_t views);

}  // namespace si
