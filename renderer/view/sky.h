// The sky behind a scene and the ambient light that it gives. Pure CPU, linear Rec. 709 colours; white is 1.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace si {

struct FittedLight;

struct Sky {
    glm::dvec3 zenith{0}, horizon{0}, below{0};
    /// Of a surface turned to the brightest part of the sky and of one turned away, before shading.ambient: their mean has
    /// a luminance of 1. That part is straight up but for `sunward` times the level part of the way to the sun.
    glm::dvec3 ambient_up{1}, ambient_down{1};
    double sunward = 0;
    glm::dvec3 to_sun{0, 1, 0};  ///< unit
    double glow = 0;             ///< how much brighter the sky is where the sun stands, as a share
};

/// The direction to the brightest directional light; without one, to a sun half way up.
glm::dvec3 sun_of(std::span<const FittedLight> lights);

/// Colours by the sun's height: of day, of a low sun, and of dusk below the horizon.
/// @param to_sun unit
Sky sky_of(const glm::dvec3& to_sun);

/// Rec. 709.
double luminance(const glm::dvec3& colour);

}  // namespace si
