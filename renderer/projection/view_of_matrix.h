// A light view from a matrix of any origin: an engine's shadow map.
#pragma once

#include <glm/glm.hpp>

#include "renderer/projection/light_view.h"

namespace si {

/// Returns the view of a shadow map whose clip-space matrix is known. Place, axes, depth range and warp follow from the
/// matrix alone: the eye is the point in which its rays meet, at infinity for parallel rays. It accepts frusta off
/// their axis, unequal width and height, mirrored maps, a w that changes from row to row (LiSPSM), and a far plane at
/// infinity, which then lies at 1e8 times the near plane.
/// @param clip_from_world any positive multiple; w is above 0 in the map
/// @throws Error if the matrix is not finite or not invertible, if a corner of its depth range lies behind the light,
/// if depth runs against the convention, or if depth or w depends on the column of the map
LightView view_of_matrix(const glm::dmat4& clip_from_world, const DepthConvention& convention);

/// Returns true when a view shows triangles with the opposite winding: its map is mirrored.
bool is_mirrored(const LightView& view);

/// Returns true for parallel rays whose clip-space w changes from column to column of the map and not from row to row.
/// view_of_matrix() refuses such a matrix, and takes it once its rows for x and y are exchanged.
bool is_warped_by_column(const glm::dmat4& clip_from_world);

}  // namespace si
