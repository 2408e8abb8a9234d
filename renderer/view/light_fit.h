// Where the lights stand and what their shadow maps cover. Pure CPU, double precision, no GL.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"
#include "renderer/view/depth_curve.h"

namespace si {

/// One square shadow map image: a view and projection.
struct LightView {
    glm::dvec3 eye{0};           ///< world
    glm::dmat3 axes{1.0};        ///< columns right, up, back (the view looks along -back)
    glm::dmat4 projection{1.0};  ///< to clip space of curve.convention
    DepthCurve curve;
    double half_width = 1;  ///< orthographic: half extent in metres; perspective: tan of the half angle
    /// Clip space from positions relative to `origin` (world), composed in double.
    glm::dmat4 clip_from_relative(const glm::dvec3& origin) const;
    /// The world position seen at map coordinates `uv`, z metres along the axis.
    glm::dvec3 position_ws(const glm::dvec2& uv, double z) const;
    /// World size of a texel at distance z (metres).
    double texel_size(double z, int resolution) const {
        return 2 * half_width * (curve.perspective ? z : 1.0) / resolution;
    }
};

/// What no bias and no kernel can mend; see map_limits().
struct MapLimits {
    bool one_depth_step = false;       ///< all depth lies in one step of the map's format
    bool one_texel = false;            ///< a texel is larger than the scene
    double step_m = 0, depth_m = 0;    ///< along the light's axis: that step at its coarsest, and what the map holds
    double texel_m = 0, across_m = 0;  ///< width of a texel at the scene's centre, and of what the map holds
    bool any() const { return one_depth_step || one_texel; }
};

struct FittedLight {
    LightType type = LightType::Directional;
    glm::dvec3 position{0};        ///< world; directional: as the settings place it, before a fit centres the map
    glm::dvec3 target{0};          ///< world; what `position` is `to_light` away from
    glm::dvec3 to_light{0, 1, 0};  ///< unit; directional: towards the light; spot: against its axis
    double cos_cone_outer = -1, cos_cone_inner = -1;
    double range_m = 0;              ///< of spot and point lights: no light from there on; 0: unlimited
    glm::dvec3 radiance{1};          ///< colour × intensity, normalised to the scene's centre (see fit_lights)
    bool casts = false;              ///< has views and anything to draw into them
    std::string reason;              ///< why it casts nothing
    glm::dvec3 map_origin{0};        ///< world; what the shaders that draw its maps count positions from
    std::vector<LightView> views;    ///< 1, or 6 faces (+x -x +y -y +z -z)
    int clipped_casters = 0;         ///< objects reaching in front of the near plane
    MapLimits limits;                ///< of lights that cast
    std::vector<std::string> notes;  ///< values clamped on the way, and what the map cannot do
};

/// Whether a light of this range (0: unlimited) shines so far.
constexpr bool within_range(double distance_m, double range_m) {
    return range_m <= 0 || distance_m < range_m;
}

/// Fits every light 0..light_count-1 to the scene. Spot and point intensities fall with the square of the distance
/// and are scaled together so that the brightest light contributes 1 at the scene's centre.
/// @param max_resolution the GL limit on texture size
std::vector<FittedLight> fit_lights(const Scene& scene, const Settings& settings, int max_resolution = 16384);

/// A right-handed orthonormal basis whose third column is unit vector n, without branches on near-parallel axes.
/// Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
glm::dmat3 orthonormal_basis(const glm::dvec3& n);

/// Unit vector of an azimuth (degrees about +y, 0 = +z, 90 = +x) and elevation (degrees above the horizon); exact at
/// multiples of 90.
glm::dvec3 direction_from_angles(double azimuth_deg, double elevation_deg);

}  // namespace si
