// Which of a light's views a point is looked up in: shaders/lib/view_choice.glsl in double.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "renderer/view/light_view.h"

namespace si {

/// The only view, or of six the one of the largest coordinate from the light's place.
enum class ViewChoice { One, Face };

struct ChosenView {
    std::size_t view = 0;
};

struct ViewChooser {
    ViewChoice choice = ViewChoice::One;
    glm::dvec3 from_ws{0};  ///< Face: the light's place
    /// @param views of the light; never empty
    ChosenView choose(std::span<const LightView> views, const glm::dvec3& point_ws) const;
};

}  // namespace si
