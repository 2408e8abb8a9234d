// How much bias a planar receiver needs, in closed form. Pure CPU, double precision.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

/// A receiver's plane as the shadow map sees it: its depth is affine in the map coordinates (u, v), for orthographic
/// and perspective lights alike, as a projective map sends planes to planes: d(u,v) = d0 + g.x u + g.y v.
struct ReceiverPlane {
    glm::dvec2 gradient{0};  ///< depth-buffer units per map width; infinite edge-on to the light, never NaN
    glm::dvec3 uvd{0};       ///< map coordinates and depth of the point that it was made from
    double w = 1;            ///< clip-space w there: metres along the axis (perspective) or 1
    /// The light sees it as a line: it has no depth as a function of (u, v).
    bool edge_on() const { return !std::isfinite(gradient.x) || !std::isfinite(gradient.y); }
    /// Its depth at map coordinates; that of the point everywhere when edge-on.
    double at(const glm::dvec2& uv) const {
        return edge_on() ? uvd.z : uvd.z + glm::dot(gradient, uv - glm::dvec2(uvd.x, uvd.y));
    }
};

/// The plane through `point_ws` with normal `normal_ws` (world; any length), without screen derivatives: with T the
/// transform to (u, v, d, w) and pi the plane, pi' = T^-T pi = (a, b, c, e) gives the gradient -(a, b) / c.
ReceiverPlane receiver_plane(const LightView& view, const glm::dvec3& point_ws, const glm::dvec3& normal_ws);

/// The smallest step of a map format at a depth in [0,1]: 1 / (2^n - 1) for n-bit formats, one ulp for floats.
double depth_quantum(MapFormat format, double depth);
/// The same of maps that hold distances, too, whose steps are depths by the curve of their view.
double depth_quantum(MapFormat format, const DepthCurve& curve, double depth);

/// The parts of the least bias, in depth-buffer units.
struct LeastBias {
    double kernel = 0;    ///< taps read texels up to kappa away on a tilted plane
    double quantum = 0;   ///< storing rounds
    double snapping = 0;  ///< vertices snap to the rasteriser's sub-pixel grid
    double rounding = 0;  ///< shaders compute in single precision
    /// What is left where every texel is compared with the plane's own depth at its centre.
    double rest() const { return quantum + snapping + rounding; }
    double total() const { return kernel + rest(); }
};

/// The least depth bias under which a plane does not shadow itself:
///   b_min = kappa (|g_u| + |g_v|) / N + q c_q + 2^-(B+1) (|g_u| + |g_v|) / N + e_fp.
/// @param kappa_texels how far a tap's texel centre may lie from the receiver, per axis: 0.5 nearest, 1 filtered 2x2,
///        R + 0.5 for (2R+1)^2 nearest and R + 1 for (2R+1)^2 bilinear taps
/// @param quantum step of the stored depth; c_q = 1, as a driver may truncate
/// @param subpixel_bits GL_SUBPIXEL_BITS; 0 or less leaves the snapping out
/// @param rounding e_fp, see rounding_bias()
LeastBias least_bias(const glm::dvec2& gradient, double kappa_texels, int resolution, double quantum, int subpixel_bits,
                     double rounding = 0);

/// What float roundings in the shaders are worth in depth at a point: 4 2^-23 max(|P| (|d'| + d |w'| / w), d). The
/// first is that of the coordinates (up to `extent_m` metres), where a warped view divides by a w of theirs; the second
/// that of the depth itself, which is what remains in a perspective map whose depths crowd at 1.
double rounding_bias(const LightView& view, const glm::dvec3& point_ws, double extent_m);

/// What roundings of map coordinates are worth on a plane, 4 2^-23 |P| (1 / across + |w'| / w) (|g_u| + |g_v|): they
/// count where texels are compared with the plane's depth at their place. `across` is the width of the map at the point
/// in its shortest texels, metres; w' that of a warped view.
double uv_rounding_bias(const LightView& view, const glm::dvec3& point_ws, const glm::dvec2& gradient, double extent_m,
                        int resolution);

/// The least offset along the normal (metres) that does the work of a depth bias `b_min`: moving a plane by h along n
/// moves it by h / |n . r| along the light's ray r, so h is |n . r| times the metres that b_min is worth. For an
/// orthographic light and texel s this is kappa s sin(theta) (|cos phi| + |sin phi|) + delta_z cos(theta), never more
/// than sqrt(2) kappa s plus the step. Holbert, Saying Goodbye to Shadow Acne, GDC 2011.
double least_normal_offset(const LightView& view, const glm::dvec3& point_ws, const glm::dvec3& normal_ws,
                           double b_min);

/// Length of the lit gap on the receiver beside an occluder that touches it, for a bias of `bias_m` metres along the
/// light's ray that meets the receiver at `theta_rad` from its normal: b sin(theta).
double contact_gap(double bias_m, double theta_rad);

}  // namespace si
