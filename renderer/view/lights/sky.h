// The sky behind a scene and the ambient light that it gives. Pure CPU, linear Rec. 709 colours; white is 1.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace si {

struct FittedLight;

struct Sky {
    glm::dvec3 zenith{0}, horizon{0}, below{0};
    glm::dvec3 ambient{1};       ///< before shading.ambient, of luminance 1: of a surface turned sideways
    double rise = 0;             ///< how much more one gets that is turned to the brightest part of the sky, as a share
    double sunward = 0;          ///< that part is straight up but for this times the level part of the way to the sun
    glm::dvec3 to_sun{0, 1, 0};  ///< unit
    double glow = 0;             ///< how much brighter the sky is where the sun stands, as a share
};

/// The direction to the brightest directional light; without one, to a sun half way up.
glm::dvec3 direction_to_brightest_sun(std::span<const FittedLight> lights);

/// Colours by the sun's height: of day, of a low sun, and of dusk below the horizon.
/// @param to_sun unit
Sky sky_for_sun(const glm::dvec3& to_sun);

/// Rec. 709.
double luminance(const glm::dvec3& colour);

}  // namespace si
