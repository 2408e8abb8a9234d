// Projection matrices for cameras and lights.
#pragma once

#include <glm/glm.hpp>

#include "renderer/projection/depth_curve.h"

namespace si {

/// Returns the projection matrix from view space to the clip space of curve.convention; the view looks along -z.
/// @param curve depth range, and perspective or parallel rays
/// @param half_x,half_y half of the view's width and height: metres for parallel rays; in perspective, tangents of half
/// the angles
glm::dmat4 projection_matrix(const DepthCurve& curve, double half_x, double half_y);

/// Returns the matrix from clip space to homogeneous map coordinates (u, v) and depth, all in [0,w]. Used to look up
/// shadow maps.
glm::dmat4 uvd_from_clip(const DepthConvention& convention);
/// Converts normalised device coordinates to map coordinates (u, v) and depth, all in [0,1].
glm::dvec3 uvd_from_ndc(const DepthConvention& convention, const glm::dvec3& ndc);

/// Returns the view-projection matrix for positions relative to `origin`. The difference origin - eye is computed in
/// double precision, so the result is precise at any distance from the world's origin.
/// @param axes columns right, up, back of the view
/// @param eye,origin world
glm::dmat4 clip_from_relative(const glm::dmat4& projection, const glm::dmat3& axes, const glm::dvec3& eye,
                              const glm::dvec3& origin);

}  // namespace si
