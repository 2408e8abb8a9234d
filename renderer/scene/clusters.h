// Large meshes in pieces of what lies together: what a camera sees of one is less than its box.
#pragma once

#include <vector>

#include "renderer/scene/scene.h"

namespace si {

/// Boxes that hold every triangle of a mesh between them, in its own space: one of small meshes, at most some thousand
/// of large ones. Takes time in proportion to the triangles.
std::vector<Bounds> clusters_of(const Mesh& mesh);

/// Indices of large meshes are drawn in runs of so many.
inline constexpr std::size_t kRunIndices = 3 * 1024;
/// Boxes of the runs of a mesh's indices, in its own space; none of a mesh that is too small to be drawn in runs.
std::vector<Bounds> run_boxes_of(const Mesh& mesh);

}  // namespace si
