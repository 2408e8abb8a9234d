// Bias of one surface point, term by term: what the settings give and the least that is needed. CPU, double precision.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "renderer/bias/light_receiver.h"
#include "renderer/bias/theory.h"
#include "renderer/gl/raster_traits.h"

namespace si {

/// Surface point whose bias bias_breakdown() computes: position, normals, and the origin of positions in shaders.
struct SurfacePoint {
    glm::dvec3 position_ws{0};
    glm::dvec3 geometric{0, 1, 0};    ///< unit normal of the triangle, on the side that the camera sees
    glm::dvec3 bias_normal{0, 1, 0};  ///< unit, the normal that bias.normal_source selects
    glm::dvec3 origin_ws{0};          ///< Camera::origin(), to which positions in shaders are relative
    bool in_map = true;  ///< the triangle is drawn into maps: neither culled nor part of an object that casts no shadow
    /// Corners of the triangle, world space. Their greatest depth sets the unit of polygon offset in float formats;
    /// without corners the depth of the point does.
    std::optional<std::array<glm::dvec3, 3>> corners_ws = std::nullopt;
};

/// Shift of a point's depth in three units: depth-buffer units, texels and metres. Texels and metres come from the
/// light view's inverse depth curve, which converts depth-buffer values to distances. In perspective maps they are not
/// proportional to the depth, and they never exceed the distance to the light.
struct DepthShift {
    double depth = 0;   ///< depth-buffer units; above 0 is towards the light
    double texels = 0;  ///< along the view's axis, in texel widths at the point (the unit of bias.unit)
    double metres = 0;  ///< along the light's ray
};

/// Depth bias of one surface point, split by the setting that causes it, and the least bias that avoids acne there.
struct BiasBreakdown {
    LightReceiver receiver;
    ReceiverPlane plane;
    DepthCurve curve;      ///< along the light's ray through the point
    double theta_rad = 0;  ///< angle between the triangle's normal and the light
    LeastBias least;       ///< depth-buffer units; 0 where the surface is not in the map
    bool in_map = true;    ///< the surface is drawn into the map, and can then shadow itself

    // Equivalent depth bias of each setting, in depth-buffer units: the distance that it puts between the compared
    // depth and the receiver's plane.
    double constant = 0;      ///< depth bias by bias.constant, depth-buffer units; 0 where the slope bias is larger
    double slope = 0;         ///< depth bias by bias.slope, depth-buffer units; 0 where the constant bias is larger
    double bias_of_kind = 0;  ///< depth bias by bias.kind with constant and slope 0 (Bias::gives_needed_bias)
    /// Equivalent depth bias of the normal offset h (bias.normal), in depth-buffer units: depth between the moved point
    /// and the receiver's plane. Along the light's ray this is h times 1 / cos(theta) for bias.normal_by length,
    /// tan(theta) for sine, (1 - cos(theta)) / cos(theta) for one-minus-cosine, and sin(theta) tan(theta) for sideways.
    /// Theta is the angle between the surface normal and the light. Infinite for a plane edge-on to the light.
    double normal = 0;
    /// Equivalent depth bias of polygon offset (bias.raster_*, as the driver applies it) and of an engine's shift of
    /// casters (LightView::caster_shift), in depth-buffer units.
    double raster = 0;

    /// Returns the equivalent depth bias of all settings: the depth bias that acts against acne as much as all bias
    /// settings together, in depth-buffer units. The surface does not shadow itself when this bias is at least
    /// least.total().
    double equivalent_depth() const { return constant + slope + bias_of_kind + normal + raster; }
    /// Shift of the compared depth towards the light, in depth-buffer units. Occluders closer to the receiver than this
    /// shift cast no shadow. The normal offset counts only by its part along the light's ray.
    double depth_shift = 0;
    bool per_texel = false;  ///< every texel is compared with a depth of its own (Bias::per_texel)
    /// Largest difference between a texel's compared depth and the compared depth at the look-up (bias.plane_clamp), in
    /// depth-buffer units; infinite: no limit.
    double max_texel_shift = 0;
    /// Additional bias of a tap for each texel of its distance from the look-up, in depth-buffer units
    /// (Bias::remainder); 0: none.
    double remainder_per_texel = 0;
    MapSize map_size{1};  ///< texels of the map
    /// Returns the depth of the receiver, with its bias, that is compared with one texel of the shadow map.
    /// @param centre map coordinates of the texel's centre
    double compared_depth_at(const glm::dvec2& centre) const;
    /// Converts a depth shift at the surface point from depth-buffer units to texels and metres.
    DepthShift amount(double depth) const {
        const double along_axis = curve.metres_towards_light(receiver.own_m, depth);
        return {depth, along_axis / receiver.texel_m, along_axis / receiver.axis_per_ray};
    }
    double moved_aside_m = 0;  ///< metres that a sideways normal offset adds to contact_gap_m(), beside its depth bias
    /// Returns the largest width in metres of the lit strip next to a caster that touches the receiver (peter-panning).
    /// It is the bias along the light's ray times sin(theta), with theta between the surface normal and the light. For
    /// a normal offset of length h this is h tan(theta). A caster nearly parallel to the light's rays gets a lit strip
    /// of this width. At other casters the shadow's edges shift by it. For bias.normal_by sideways (only the offset's
    /// part across the light's ray) the width is h tan(theta) with the whole offset h (bias.normal in metres).
    double contact_gap_m() const;
    /// Returns the distance in metres by which the normal offset moves shadow edges along the surface: the part of the
    /// offset across the light's ray, divided by cos(theta), with theta between the surface normal and the light.
    double offset_shift_m() const;
};

/// Computes the bias that the settings give a surface point under a light's shadow map, with the share of each setting,
/// and the least bias that avoids acne there.
/// @param size texels of the light's maps
/// @param driver Renderer::driver(); its polygon offset matters where bias.raster_* are not 0
/// @param kernel_reach_texels reach of the kernel (kernel_reach_in_light().bias), the same for all points; none:
/// computed by this call
BiasBreakdown bias_breakdown(const FittedLight& light, const Settings& settings, MapSize size,
                             const SurfacePoint& point, const RasterTraits& driver,
                             std::optional<double> kernel_reach_texels = {});

}  // namespace si
