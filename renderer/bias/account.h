// What bias a surface point gets from the settings, term by term, and what it needs. Pure CPU, double precision.
#pragma once

#include <glm/glm.hpp>

#include "renderer/bias/light_receiver.h"
#include "renderer/bias/theory.h"
#include "renderer/gl/raster_traits.h"

namespace si {

/// A point on a triangle, and what of the picture its bias depends on.
struct SurfacePoint {
    glm::dvec3 position_ws{0};
    glm::dvec3 geometric{0, 1, 0};    ///< unit normal of the triangle, on the side that the camera sees
    glm::dvec3 bias_normal{0, 1, 0};  ///< unit, the one that bias.normal_source chooses
    glm::dvec3 origin_ws{0};          ///< what the picture's shaders count positions from: Camera::origin()
};

/// How far a point's depth moves, three times. Texels and metres are those that the point moves by, found by the
/// inverse of the depth curve: in perspective maps they are no multiples of the depth, and never more than there is to
/// the light.
struct DepthShift {
    double depth = 0;   ///< depth-buffer units; above 0 is towards the light
    double texels = 0;  ///< along the view's axis in widths of a texel at the point, as bias.unit has them
    double metres = 0;  ///< along the light's ray
};

struct BiasBreakdown {
    LightReceiver receiver;
    ReceiverPlane plane;
    DepthCurve curve;      ///< of the receiver's view
    double theta_rad = 0;  ///< between the triangle's normal and the light
    LeastBias least;       ///< depth-buffer units

    // What each setting is worth against acne: how far it brings the compared depth before the receiver's own plane.
    double constant = 0, slope = 0;  ///< only the larger one acts; the other is 0
    double by_itself = 0;            ///< what bias.kind gives whatever the numbers are (Bias::brings_need)
    /// Of the normal offset: h / |n . ray|, as the look-up moves along the plane; infinite for a plane edge-on.
    double normal = 0;
    /// Of bias.raster_*, on this plane, by what the driver makes of them (PolygonOffset).
    double raster = 0;

    /// All of them: the surface does not shadow itself when this is at least least.total().
    double clears() const { return constant + slope + by_itself + normal + raster; }
    /// How far the compared depth is moved towards the light: a surface nearer to the receiver than this is lost. Of
    /// the normal offset that is only its part along the light.
    double depth_shift = 0;
    /// Whether every texel is compared with a depth of its own (Bias::per_texel), and by how much that may differ from
    /// the one at the look-up (bias.plane_clamp).
    bool per_texel = false;
    double max_texel_shift = 0;
    /// The depth that is compared with a texel. @param centre its map coordinates
    double compared_depth_at(const glm::dvec2& centre) const;
    DepthShift amount(double depth) const {
        const double along_axis = curve.metres_nearer(receiver.own_m, depth);
        return {depth, along_axis / receiver.texel_m, along_axis / receiver.axis_per_ray};
    }
    /// Width of the lit strip on the receiver beside a caster that touches it, in metres: the bias along the ray times
    /// sin(theta), which is h tan(theta) for a normal offset.
    double contact_gap_m() const;
};

/// @param resolution of the map
/// @param driver Renderer::driver(); its polygon offset matters where bias.raster_* are not 0
BiasBreakdown bias_breakdown(const FittedLight& light, const Settings& settings, int resolution,
                             const SurfacePoint& point, const RasterTraits& driver);

}  // namespace si
