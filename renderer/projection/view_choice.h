// Choice of the view (cascade, cube face, clip level) in which a point is looked up: shaders/lib/view_choice.glsl in
// double precision.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "renderer/projection/light_view.h"

namespace si {

/// Rule that chooses among a light's views (shadow maps) the one in which a point is looked up. One: the only view.
/// Face: cube face by the largest coordinate from the light. Interval: by camera depth. Map: the first map that
/// contains the point. Distance: by distance from the camera.
enum class ViewChoice { One, Face, Interval, Map, Distance };

/// Limits of one cascade or clip level (one of several virtual maps around the camera): where it ends, and where its
/// blend into the next begins. The unit depends on the rule (ViewChoice). Interval: metres of camera depth. Map:
/// max(|u|, |v|), measured from the map's centre; 0.5 is the map's edge. Distance: metres.
struct ViewSpan {
    double ends = 0;         ///< end of the view
    double blends_from = 0;  ///< start of the blend
};

/// Choice of the cascade, cube face or clip level of a light in which a point is looked up, and of the next one with
/// which the result is blended.
struct ChosenView {
    std::size_t view = 0;   ///< index among the light's views
    std::size_t other = 0;  ///< view blended in; equal to `view` without a blend
    double share = 0;       ///< weight of `other`, 0 to 1
};

/// Rule and limits for choosing the view of a light (cascade, cube face or clip level) in which a point is looked up.
struct ViewChooser {
    ViewChoice choice = ViewChoice::One;
    glm::dvec3 from_ws{0};        ///< position of the light (Face) or of the camera (Interval, Distance)
    glm::dvec3 forward{0};        ///< unit viewing direction of the camera (Interval)
    std::vector<ViewSpan> spans;  ///< limits by view; empty for One and Face
    /// Chooses the cascade, cube face or clip level of a light in which a world-space point is looked up; the last one
    /// if none contains the point.
    /// @param views views of the light; never empty
    ChosenView choose(std::span<const LightView> views, const glm::dvec3& point_ws) const;
};

/// Returns a short name of a cube face, cascade or clip level of a light, such as "+x" or "2".
/// @param view index among the light's views
std::string view_short_name(ViewChoice choice, std::size_t view);
/// Returns a name of a cube face, cascade or clip level of a light, such as "face +x" or "cascade 2 of 4"; empty if it
/// is the light's only view.
/// @param view index among the light's views
/// @param views number of the light's views
std::string view_name(ViewChoice choice, std::size_t view, std::size_t views);

}  // namespace si
