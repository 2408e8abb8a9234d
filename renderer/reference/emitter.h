// A light as the truth sees it: where its rays come from, and how large it is.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Directional lights are disks on the sky, spot lights disks across their axis, point lights spheres.
struct Emitter {
    LightType type = LightType::Directional;
    glm::dvec3 position_ws{0};     ///< spot and point
    glm::dvec3 to_light{0, 1, 0};  ///< unit; directional: towards the light; spot: against its axis
    double cos_cone = -1;          ///< of the spot's outer half angle
    double range_m = 0;            ///< spot and point: no light from there on; 0: unlimited
    double size = 0;               ///< light.size: angular radius in degrees (directional) or radius in metres
    bool casts = true;

    /// Unit vector from a point to the light's centre; metres to it, infinite for directional lights.
    glm::dvec3 direction_from(const glm::dvec3& point_ws, double& distance_m) const {
        distance_m = std::numeric_limits<double>::infinity();
        if (type == LightType::Directional) return to_light;
        const glm::dvec3 d = position_ws - point_ws;
        distance_m = glm::length(d);
        return distance_m > 0 ? d / distance_m : to_light;
    }
    /// Whether a point lies in the spot's cone; always for other lights.
    bool in_cone(const glm::dvec3& to_light_from_point) const {
        return type != LightType::Spot || glm::dot(to_light_from_point, to_light) > cos_cone;
    }
};

Emitter emitter_of(const FittedLight& light, const LightSettings& settings);

/// Where a ray to a part of the light goes: along `towards` for `length` times its length.
struct LightRay {
    glm::dvec3 towards{0};  ///< metres, or unit length and endless for directional lights
    double length = 1;
};

/// Points of the light in n x n equal parts, one jittered in each, by a fixed seed: the same for a pixel each time.
/// Mitchell, Consequences of Stratified Sampling in Graphics, SIGGRAPH 1996: the error falls with (n^2)^(-3/4) at an
/// edge, where independent points give (n^2)^(-1/2). Disks by the concentric map of Shirley and Chiu, A Low Distortion
/// Map Between Disk and Square, 1997; spheres by the solid angle that they fill.
class LightSamples {
public:
    LightSamples(const Emitter& emitter, const glm::dvec3& point_ws, int parts_per_axis, std::uint64_t pixel);
    /// The ray to part (x, y).
    LightRay ray(int x, int y) const;

private:
    const Emitter& emitter_;
    glm::dvec3 point_;
    glm::dmat3 axes_;           ///< across, across, towards the light
    double radius_ = 0;         ///< of the disk: metres, or of the unit sphere of directions
    double one_minus_cos_ = 0;  ///< of the angle that a sphere or the sky's disk fills
    double distance_ = 0;
    int parts_;
    std::uint64_t seed_;
};

}  // namespace si
