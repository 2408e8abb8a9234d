// Conversion between distance along a view's axis and depth-buffer values. CPU, double precision.
#pragma once

#include <optional>

namespace si {

/// Depth range and direction of clip space, from which compare function, clear value, linearisation and bias sign
/// follow.
struct DepthConvention {
    bool zero_to_one = true;  ///< clip z in [0,w] (glClipControl) instead of [-w,w]
    bool reversed = false;    ///< near maps to 1, far to 0
    bool operator==(const DepthConvention&) const = default;
    /// Returns the depth-buffer value of the near plane.
    double near_depth() const { return reversed ? 1.0 : 0.0; }
    /// Returns the depth-buffer value of the far plane.
    double far_depth() const { return reversed ? 0.0 : 1.0; }
};

/// Depth ranges of the rows of a warped map (LiSPSM). At map coordinate v the range goes from middle_m + near_m / (1 +
/// rise v) to middle_m + far_m / (1 + rise v), metres along the axis. Along each ray depth stays linear.
struct DepthWarp {
    double middle_m = 0, near_m = 0, far_m = 0;
    double rise = 0;  ///< above -1
    bool operator==(const DepthWarp&) const = default;
};

/// Depth-buffer value as a function of distance along the axis of a projection, and its inverse.
struct DepthCurve {
    bool perspective = false;
    double near = 0.1;  ///< near plane, metres along the axis; for a warped map the nearest of all rows
    double far = 100;   ///< far plane, metres along the axis; for a warped map the farthest of all rows
    DepthConvention convention;
    std::optional<DepthWarp> warp;  ///< set for a warped map; use the functions of curve_at_row() there
    /// Returns the depth curve of the rays through one row of a warped map.
    /// @param v map coordinate, clamped to [0,1]
    DepthCurve curve_at_row(double v) const;
    /// Returns the depth-buffer value in [0,1] at a distance z along the axis, metres.
    double depth(double z) const;
    /// Returns the distance in metres along the axis at a depth-buffer value; the inverse of depth().
    double distance(double d) const;
    /// Returns the depth-buffer value at a fraction of the depth range; for reversed depth the fraction counts from
    /// `far`. A `share` outside (0,1) is returned unchanged.
    double depth_at_fraction(double share) const;
    /// Returns the slope of the depth-buffer value at distance z along the axis: |d depth / d z|, per metre.
    double slope(double z) const;
    /// Returns the change of the depth-buffer value when a point at distance z moves towards the light. The point stays
    /// at least a thousandth of `near` away.
    /// @param z metres along the axis
    /// @param metres move along the axis; below 0: away from the light
    double depth_change_towards_light(double z, double metres) const;
    /// Returns the move along the axis towards the light, in metres, that changes the depth-buffer value of a point by
    /// `depth`; the inverse of depth_change_towards_light(). At most z in perspective; infinite for an infinite depth.
    /// @param z metres along the axis
    /// @param depth change towards the light, depth-buffer units
    double metres_towards_light(double z, double depth) const;
    bool operator==(const DepthCurve&) const = default;
};

}  // namespace si
