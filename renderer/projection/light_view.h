// One shadow map image: where it looks from and how.
#pragma once

#include <glm/glm.hpp>

#include "renderer/projection/depth_curve.h"

namespace si {

/// Metres along the directions in which a texel is longest and shortest.
struct TexelSize {
    double longest = 0, shortest = 0;
};

/// One square shadow map image: a view and projection.
struct LightView {
    glm::dvec3 eye{0};           ///< world
    glm::dmat3 axes{1.0};        ///< columns right, up, back (the view looks along -back)
    glm::dmat4 projection{1.0};  ///< to clip space of curve.convention
    DepthCurve curve;
    bool clamps_near = false;  ///< casters before the near plane are drawn on it
    double half_width = 1;  ///< orthographic: half extent in metres (warped: of what it holds); perspective: tan of the
                            ///< half angle
    /// Clip space from positions relative to `origin` (world), composed in double.
    glm::dmat4 clip_from_relative(const glm::dvec3& origin) const;
    /// Whether the rays are parallel but w of clip space changes across them (light.fit lispsm): texels differ in size
    /// from row to row, and each row has a range of depths of its own.
    bool warped() const { return curve.warp.has_value(); }
    /// The world position seen at map coordinates `uv`, z metres along the axis.
    glm::dvec3 position_ws(const glm::dvec2& uv, double z) const;
    /// World size of a texel at distance z (metres). Not of a warped view.
    double texel_size(double z, int resolution) const {
        return 2 * half_width * (curve.perspective ? z : 1.0) / resolution;
    }
    /// World size of the texel that a point falls into, across its ray. The two lengths differ in a warped view only.
    TexelSize texel_size_at(const glm::dvec3& point_ws, int resolution) const;
    /// The smallest and the largest of all texels; in perspective of those within the range.
    TexelSize texel_size_range(int resolution) const;
    /// Depths along the ray through a point.
    DepthCurve ray_depth_curve(const glm::dvec3& point_ws) const;
    /// Of what a metre across the rays changes w by, as a share of w, at a point; 0 where w does not change.
    double relative_dw_per_m(const glm::dvec3& point_ws) const;
};

}  // namespace si
