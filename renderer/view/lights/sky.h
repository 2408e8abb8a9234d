// Sky colours behind a scene and the ambient light of the sky. CPU, linear Rec. 709 colours; white is 1.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace si {

struct FittedLight;

/// Colours of the sky gradient and of its ambient light.
struct Sky {
    glm::dvec3 zenith{0};  ///< straight up
    glm::dvec3 horizon{0};
    glm::dvec3 below{0};    ///< ground below the horizon
    glm::dvec3 ambient{1};  ///< ambient light on a vertical surface, luminance 1, before shading.ambient
    double rise = 0;        ///< extra ambient share on a surface facing the brightest part of the sky
    double sunward = 0;     ///< the brightest part lies along up plus `sunward` times the horizontal part of `to_sun`
    glm::dvec3 to_sun{0, 1, 0};  ///< unit
    double glow = 0;             ///< extra brightness around the sun, as a share
};

/// Returns the unit direction to the brightest directional light. Without such a light, returns that of a default sun
/// 49 degrees above the horizon. Used to draw the sky.
glm::dvec3 direction_to_brightest_sun(std::span<const FittedLight> lights);

/// Returns the colours of the sky and its ambient light for a sun direction. They are interpolated by the sun's height:
/// day, low sun, or dusk below the horizon.
/// @param to_sun unit direction to the sun
Sky sky_for_sun(const glm::dvec3& to_sun);

/// Returns the relative luminance of a linear Rec. 709 colour; 1 for white.
double luminance(const glm::dvec3& colour);

}  // namespace si
