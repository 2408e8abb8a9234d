// One shadow map image: where it looks from and how.
#pragma once

#include <glm/glm.hpp>

#include "renderer/view/depth_curve.h"

namespace si {

/// One square shadow map image: a view and projection.
struct LightView {
    glm::dvec3 eye{0};           ///< world
    glm::dmat3 axes{1.0};        ///< columns right, up, back (the view looks along -back)
    glm::dmat4 projection{1.0};  ///< to clip space of curve.convention
    DepthCurve curve;
    bool clamps_near = false;  ///< casters before the near plane are drawn on it
    double half_width = 1;     ///< orthographic: half extent in metres; perspective: tan of the half angle
    /// Clip space from positions relative to `origin` (world), composed in double.
    glm::dmat4 clip_from_relative(const glm::dvec3& origin) const;
    /// The world position seen at map coordinates `uv`, z metres along the axis.
    glm::dvec3 position_ws(const glm::dvec2& uv, double z) const;
    /// World size of a texel at distance z (metres).
    double texel_size(double z, int resolution) const {
        return 2 * half_width * (curve.perspective ? z : 1.0) / resolution;
    }
};

}  // namespace si
