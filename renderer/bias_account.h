// What bias a surface point gets from the settings, term by term, and what it needs. Pure CPU, double precision.
#pragma once

#include <glm/glm.hpp>

#include "renderer/bias_theory.h"
#include "renderer/light_receiver.h"
#include "renderer/polygon_offset.h"

namespace si {

/// A point on a triangle, and what of the picture its bias depends on.
struct SurfacePoint {
    glm::dvec3 position_ws{0};
    glm::dvec3 geometric{0, 1, 0};    ///< unit normal of the triangle, on the side that the camera sees
    glm::dvec3 bias_normal{0, 1, 0};  ///< unit, the one that bias.normal_source chooses
    glm::dvec3 eye_ws{0};             ///< the camera's: shaders count positions from near it
};

/// A difference of depth along the light's axis, three times. Texels and metres are by the slope of depth at the point,
/// so that their ratio to the depth holds for large differences in perspective maps too.
struct DepthAmount {
    double depth = 0;   ///< depth-buffer units; above 0 is towards the light
    double texels = 0;  ///< widths of a texel at the point, as bias.unit has them
    double metres = 0;
};

struct BiasAccount {
    LightReceiver receiver;
    ReceiverPlane plane;
    double theta_rad = 0;     ///< between the triangle's normal and the light
    double depth_per_m = 1;
    LeastBias least;          ///< depth-buffer units

    // What each setting is worth against acne: how far it brings the compared depth before the receiver's own plane.
    double constant = 0, slope = 0;  ///< only the larger one acts; the other is 0
    double normal = 0;               ///< of the normal offset: h / |n . ray|, as the look-up moves along the plane
    /// Of bias.raster_*, on this plane, by what the driver makes of them (PolygonOffset).
    double raster = 0;

    /// All of them: the surface does not shadow itself when this is at least least.total().
    double clears() const { return constant + slope + normal + raster; }
    /// How far the compared depth is moved towards the light: a surface nearer to the receiver than this is lost. Of the
    /// normal offset that is only its part along the light.
    double lifts = 0;
    DepthAmount amount(double depth) const {
        const double metres = depth / depth_per_m;
        return {depth, metres / receiver.texel_m, metres};
    }
    /// Width of the lit strip on the receiver beside a caster that touches it, in metres: the bias along the ray times
    /// sin(theta), which is h tan(theta) for a normal offset.
    double contact_gap_m() const;
};

/// @param resolution of the map
/// @param driver Renderer::driver(); its polygon offset matters where bias.raster_* are not 0
BiasAccount bias_account(const FittedLight& light, const Settings& settings, int resolution, const SurfacePoint& point,
                         const RasterTraits& driver);

}  // namespace si
