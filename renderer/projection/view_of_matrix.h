// A light view from a matrix of any origin: an engine's shadow map.
#pragma once

#include <glm/glm.hpp>

#include "renderer/projection/light_view.h"

namespace si {

/// Finds the light view of a shadow map from its view-projection matrix, such as an engine's. Eye, axes, depth range
/// and warp follow from the matrix alone. In perspective the eye is the point where the rays meet. For parallel rays it
/// lies before the near plane, by the length of the depth range.
/// Accepts off-axis frusta, unequal width and height, mirrored maps, and a w that changes from row to row (LiSPSM).
/// Accepts a far plane at infinity too, and puts it at 1e8 times the near plane.
/// @param clip_from_world view-projection matrix, or a positive multiple of it; w is above 0 in the map
/// @param convention depth convention of the matrix
/// @throws Error if the matrix is not finite or not invertible, if a corner of its depth range lies behind the light,
/// if depth runs against the convention, or if depth or w depends on the column of the map
LightView view_of_matrix(const glm::dmat4& clip_from_world, const DepthConvention& convention);

/// Returns true when a light view's map is a mirror image, so that triangles appear in it with the opposite winding.
bool is_mirrored(const LightView& view);

/// Returns true when a light's matrix has parallel rays and a clip-space w that differs between the columns of the
/// shadow map (along x) but not between its rows (along y). view_of_matrix() rejects such a matrix. read_given_maps()
/// therefore exchanges x and y of the matrix, and columns and rows of the image.
bool is_warped_by_column(const glm::dmat4& clip_from_world);

}  // namespace si
