// Conversion between distance along a view's axis and depth-buffer values. CPU, double precision.
#pragma once

#include <optional>

namespace si {

/// Range and direction of depth in clip space: 0 to 1 or -1 to 1, normal or reversed. Compare function, clear value,
/// linearisation and bias sign follow from them.
struct DepthConvention {
    bool zero_to_one = true;  ///< clip z in [0,w] (glClipControl) instead of [-w,w]
    bool reversed = false;    ///< near maps to 1, far to 0
    bool operator==(const DepthConvention&) const = default;
    /// Returns the depth-buffer value of the near plane.
    double near_depth() const { return reversed ? 1.0 : 0.0; }
    /// Returns the depth-buffer value of the far plane.
    double far_depth() const { return reversed ? 0.0 : 1.0; }
};

/// Depth range of each row of a warped shadow map (LiSPSM). At map coordinate v the range goes from middle_m + near_m /
/// (1 + rise v) to middle_m + far_m / (1 + rise v), metres along the axis. Depth is linear along each ray.
struct DepthWarp {
    double middle_m = 0, near_m = 0, far_m = 0;
    double rise = 0;  ///< relative growth of the divisor from v = 0 to v = 1; above -1
    bool operator==(const DepthWarp&) const = default;
};

/// Mapping between distance along the axis of a camera or light view and depth-buffer value, in both directions.
struct DepthCurve {
    bool perspective = false;
    double near = 0.1;  ///< near plane, metres along the axis; for a warped map the nearest of all rows
    double far = 100;   ///< far plane, metres along the axis; for a warped map the farthest of all rows
    DepthConvention convention;
    std::optional<DepthWarp> warp;  ///< set for a warped map; use the functions of curve_at_row() there
    /// Returns the depth curve (mapping from distance to depth-buffer value) of the rays through one row of a warped
    /// shadow map. For a map that is not warped, returns this curve.
    /// @param v map coordinate, clamped to [0,1]
    DepthCurve curve_at_row(double v) const;
    /// Returns the depth-buffer value in [0,1] at a distance z along the axis of the light or camera view, metres.
    double depth(double z) const;
    /// Returns the distance in metres along the axis at a depth-buffer value `d`; the inverse of depth().
    double distance(double d) const;
    /// Converts a texel of a map that stores linear distances to the depth-buffer value at the same distance.
    /// @param share texel: fraction of the way from near to far plane, for reversed depth from far to near; returned
    /// unchanged outside (0,1)
    double depth_at_fraction(double share) const;
    /// Returns the slope of the depth-buffer value at distance z along the axis: |d depth / d z|, per metre. Used to
    /// convert a bias between metres and depth.
    double slope(double z) const;
    /// Returns how much the depth-buffer value of a point changes when the point moves towards the light, as a bias
    /// moves it. In perspective the moved point stays at least a thousandth of `near` from the light.
    /// @param z distance of the point, metres along the axis
    /// @param metres move along the axis; below 0: away from the light
    double depth_change_towards_light(double z, double metres) const;
    /// Returns how far a point has to move towards the light, in metres along the axis, to change its depth-buffer
    /// value by `depth`; the inverse of depth_change_towards_light(). In perspective, a finite depth gives at most z,
    /// and minus infinity if no point is that much deeper. An infinite depth gives infinity.
    /// @param z distance of the point, metres along the axis
    /// @param depth change towards the light, depth-buffer units
    double metres_towards_light(double z, double depth) const;
    bool operator==(const DepthCurve&) const = default;
};

}  // namespace si
