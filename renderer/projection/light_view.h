// The view and projection of one shadow map.
#pragma once

#include <glm/glm.hpp>

#include "renderer/projection/depth_curve.h"

namespace si {

/// Size of a texel in metres, measured across the light's ray, along its longest and shortest direction. Both are equal
/// unless the view is warped.
struct TexelSize {
    double longest = 0, shortest = 0;
};

/// View and projection of one square shadow map: a directional or spot map, a cube face, a cascade or a clip level.
struct LightView {
    glm::dvec3 eye{0};           ///< world
    glm::dmat3 axes{1.0};        ///< columns right, up, back (the view looks along -back)
    glm::dmat4 projection{1.0};  ///< to clip space of curve.convention
    DepthCurve curve;            ///< depth range
    bool clamps_near = false;    ///< casters before the near plane are drawn on it (pancaking)
    double half_width = 1;       ///< half extent in metres; in perspective the tangent of the half angle
    /// Returns the light view's matrix to clip space from positions relative to `origin` (world), composed in double
    /// precision.
    glm::dmat4 clip_from_relative(const glm::dvec3& origin) const;
    /// Returns true for a warped shadow map (light.fit lispsm): parallel rays, but a clip-space w that changes across
    /// them. Texels and depth ranges then differ from row to row.
    bool warped() const { return curve.warp.has_value(); }
    /// Returns the world-space position at shadow map coordinates `uv` and distance z along the light's axis, metres.
    glm::dvec3 position_ws(const glm::dvec2& uv, double z) const;
    /// Returns the world size of a shadow map texel in metres at distance z along the axis. Not valid for a warped
    /// view.
    /// @param resolution texels a side of the map
    double texel_size(double z, int resolution) const {
        return 2 * half_width * (curve.perspective ? z : 1.0) / resolution;
    }
    /// Returns the world size of the shadow map texel that contains a point, measured across the point's ray. Both
    /// lengths are equal unless the view is warped.
    /// @param resolution texels a side of the map
    TexelSize texel_size_at(const glm::dvec3& point_ws, int resolution) const;
    /// Returns the sizes of the smallest and largest texels of the shadow map; in perspective those within the depth
    /// range.
    /// @param resolution texels a side of the map
    TexelSize texel_size_range(int resolution) const;
    /// Returns the depth curve along the light's ray through a world-space point.
    DepthCurve ray_depth_curve(const glm::dvec3& point_ws) const;
    /// Returns the relative change of clip-space w per metre across the light direction (LiSPSM) at a point; 0 for
    /// unwarped views.
    double relative_dw_per_m(const glm::dvec3& point_ws) const;
};

}  // namespace si
