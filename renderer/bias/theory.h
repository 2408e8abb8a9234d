// Least bias of a planar receiver in closed form. CPU, double precision.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Plane of a receiver in the space of a shadow map. Its depth is an affine function of map coordinates (u, v): d(u,v)
/// = d0 + g.x u + g.y v. Holds for orthographic and perspective lights, as projections map planes to planes.
struct ReceiverPlane {
    glm::dvec2 gradient{0};  ///< depth-buffer units per map width; infinite edge-on to the light, never NaN
    glm::dvec3 uvd{0};       ///< map coordinates and depth of the receiver's point
    double w = 1;            ///< clip-space w at that point: metres along the axis (perspective) or 1
    /// Returns true when the plane is edge-on to the light: its depth is then no function of (u, v).
    bool edge_on() const { return !std::isfinite(gradient.x) || !std::isfinite(gradient.y); }
    /// Returns the depth of the plane at map coordinates; for an edge-on plane the depth of its point.
    double depth_at(const glm::dvec2& uv) const {
        return edge_on() ? uvd.z : uvd.z + glm::dot(gradient, uv - glm::dvec2(uvd.x, uvd.y));
    }
};

/// Returns a receiver's plane in the space of a shadow map, computed from its normal instead of screen derivatives.
/// With T the transform from the world to (u, v, d, w) and pi the plane in the world, pi' = T^-T pi = (a, b, c, e)
/// gives the gradient -(a, b) / c.
/// @param view view of the shadow map
/// @param point_ws point on the plane, world
/// @param normal_ws normal of the plane, world, any length
ReceiverPlane receiver_plane(const LightView& view, const glm::dvec3& point_ws, const glm::dvec3& normal_ws);

/// Returns the smallest step of a depth format at a depth in [0,1]: 1 / (2^n - 1) for n-bit formats, one ulp for
/// floats.
double depth_quantum(MapFormat format, double depth);
/// Returns the smallest step of a map format at a depth in [0,1], in depth-buffer units. Handles maps that store
/// distances as well: the view's depth curve converts their steps.
double depth_quantum(MapFormat format, const DepthCurve& curve, double depth);

/// Least depth bias that keeps a receiver's plane from shadowing itself, as a sum of parts: one for each reason why the
/// plane needs bias. All parts are in depth-buffer units.
struct LeastBias {
    double kernel = 0;    ///< taps read texels up to kappa texels away on a tilted plane
    double quantum = 0;   ///< rounding of stored depths to the map's format
    double snapping = 0;  ///< vertices snap to the rasteriser's sub-pixel grid
    double rounding = 0;  ///< shaders compute in single precision
    /// Returns the least bias when every texel is compared with the plane's depth at the texel's centre.
    double without_kernel() const { return quantum + snapping + rounding; }
    /// Returns the least bias, all parts together.
    double total() const { return kernel + without_kernel(); }
};

/// Computes the least depth bias with which a plane does not shadow itself, in depth-buffer units:
///   b_min = kappa (|g_u| + |g_v|) / N + q c_q + 2^-(B+1) (|g_u| + |g_v|) / N + e_fp.
/// @param gradient g, depth-buffer units per map width (ReceiverPlane)
/// @param kappa_texels largest distance of a tap's texel centre from the receiver, per axis. 0.5 for one nearest tap, 1
///        for one bilinear tap (2x2 texels). For a square of (2R+1)^2 taps: R + 0.5 if they are nearest, R + 1 if
///        bilinear
/// @param size texels of the map, N a side
/// @param quantum q, step of the stored depth; c_q = 1, as a driver may truncate
/// @param subpixel_bits B, GL_SUBPIXEL_BITS; 0 or less leaves out the term of snapped vertices
/// @param rounding e_fp, see rounding_bias()
LeastBias least_bias(const glm::dvec2& gradient, double kappa_texels, MapSize size, double quantum, int subpixel_bits,
                     double rounding = 0);

/// Returns the depth bias that covers float rounding in the shaders at a point, in depth-buffer units:
///   4 * 2^-23 * max(P * (|d'| + d * |w'| / w), d).
/// P is `extent_m`, d the depth and w the clip-space w. d' is the change of d per metre along the light's axis. w' is
/// the largest change of w per metre across the axis; it is 0 in an unwarped view. The first term of the maximum is the
/// rounding of coordinates, which a warped view also divides by w. The second is the rounding of the depth itself,
/// which dominates where perspective depths crowd at 1.
/// @param extent_m largest coordinate in the shaders, metres
double rounding_bias(const LightView& view, const glm::dvec3& point_ws, double extent_m);

/// Returns the depth bias that covers float rounding of map coordinates on a plane, in depth-buffer units:
///   2^-21 * P * (1 / across + |w'| / w) * (|g_u| + |g_v|).
/// P is `extent_m`. `across` is a length in metres: the number of texels along the map's shorter side, times the
/// shortest side of a texel at the point. w' / w is the relative change of clip-space w per metre across the light's
/// axis; it is 0 in an unwarped view. Needed where texels are compared with the plane's depth at their own centre.
/// @param gradient g, depth-buffer units per map width (ReceiverPlane)
/// @param extent_m largest coordinate in the shaders, metres
double uv_rounding_bias(const LightView& view, const glm::dvec3& point_ws, const glm::dvec2& gradient, double extent_m,
                        MapSize size);

/// Returns the normal offset in metres that acts against acne as much as the depth bias `b_min` does. Moving a plane by
/// h along its normal n moves it by h / |n . r| along the light's ray r. For an orthographic light, texel size s and
/// kernel reach kappa (texels), the offset is kappa s sin(theta) (|cos phi| + |sin phi|) + delta_z cos(theta), at most
/// sqrt(2) kappa s plus the depth step delta_z. theta is the angle between n and r, phi the direction of the slope in
/// the map. Holbert, Saying Goodbye to Shadow Acne, GDC 2011.
/// @param normal_ws normal of the plane, world, any length
/// @param b_min depth bias, depth-buffer units
double least_normal_offset(const LightView& view, const glm::dvec3& point_ws, const glm::dvec3& normal_ws,
                           double b_min);

/// Returns the length in metres of the lit gap (peter-panning) on a receiver next to an occluder that touches it:
/// b sin(theta). @param bias_m bias b along the light's ray, metres @param theta_rad angle between ray and normal
double contact_gap(double bias_m, double theta_rad);

}  // namespace si
