// Large meshes in pieces of what lies together: what a camera sees of one is less than its box.
#pragma once

#include <vector>

#include "renderer/scene/scene.h"

namespace si {

/// Boxes that hold every triangle of a mesh between them, in its own space: one of small meshes, at most some thousand
/// of large ones. Takes time in proportion to the triangles.
std::vector<Bounds> clusters_of(const Mesh& mesh);

}  // namespace si
