// Projection matrices whose depth follows a DepthCurve, for cameras and lights alike.
#pragma once

#include <glm/glm.hpp>

#include "renderer/projection/depth_curve.h"

namespace si {

/// Clip space of `curve.convention` from view space (the view looks along -z).
/// @param half_x, half_y orthographic: half extents in metres; perspective: tangents of the half angles
glm::dmat4 projection_matrix(const DepthCurve& curve, double half_x, double half_y);

/// Homogeneous map coordinates and depth, all in [0,w], from clip space, where they lie in [-w,w], depth by convention.
glm::dmat4 uvd_from_clip(const DepthConvention& convention);
/// The same after the division by w.
glm::dvec3 uvd_from_ndc(const DepthConvention& convention, const glm::dvec3& ndc);

/// `projection` x view, for positions relative to `origin`. The subtraction origin - eye happens in double, so the
/// result keeps its precision at any distance from the world's zero point.
glm::dmat4 clip_from_relative(const glm::dmat4& projection, const glm::dmat3& axes, const glm::dvec3& eye,
                              const glm::dvec3& origin);

}  // namespace si
