// Depth as a projection stores it. Pure CPU, double precision.
#pragma once

#include <optional>

namespace si {

/// Depth range and direction of a projection's clip space, from which compare, clear value, linearisation
/// and bias sign follow.
struct DepthConvention {
    bool zero_to_one = true;  ///< clip z in [0,w] (glClipControl) instead of [-w,w]
    bool reversed = false;    ///< near maps to 1, far to 0
    bool operator==(const DepthConvention&) const = default;
    double near_depth() const { return reversed ? 1.0 : 0.0; }
    double far_depth() const { return reversed ? 0.0 : 1.0; }
};

/// How the range of depths changes from row to row of a map that is warped across its rays: at map coordinate v it goes
/// from middle_m + near_m / (1 + rise v) to middle_m + far_m / (1 + rise v), metres along the axis. Along each ray
/// depth stays linear.
struct DepthWarp {
    double middle_m = 0, near_m = 0, far_m = 0;
    double rise = 0;  ///< above -1
    bool operator==(const DepthWarp&) const = default;
};

/// A projection's depth as a function of distance along its axis, and back.
struct DepthCurve {
    bool perspective = false;
    double near = 0.1,
           far = 100;  ///< of a warped map from the nearest to the farthest of what it holds; see curve_at_row()
    DepthConvention convention;
    std::optional<DepthWarp> warp;  ///< the functions below are then those of curve_at_row(), and of no warped curve
    /// The curve along the rays through the row of map coordinate v in [0,1] (beyond the map: its rim's).
    DepthCurve curve_at_row(double v) const;
    /// Depth-buffer value in [0,1] at distance z (metres along the axis).
    double depth(double z) const;
    /// Metres along the axis at depth-buffer value d. Inverse of depth().
    double distance(double d) const;
    /// Depth where a share of the range lies, counted from `near`, reversed from `far`; of a parallel projection it is
    /// the share. What is no share between 0 and 1 stays as it is.
    double depth_at_fraction(double share) const;
    /// |d depth / d z| at distance z, per metre.
    double slope(double z) const;
    /// By how much the depth of a point at distance z changes when it comes that many metres along the axis nearer to
    /// the light (below 0: farther), in depth-buffer units. It comes no nearer than a thousandth of `near`.
    double depth_change_towards_light(double z, double metres) const;
    /// Metres along the axis that a point at distance z comes nearer when its depth changes so much towards the light:
    /// the inverse of depth_change_towards_light(). Not more than z in perspective; infinite where the depth is.
    double metres_towards_light(double z, double depth) const;
    bool operator==(const DepthCurve&) const = default;
};

}  // namespace si
