// Large meshes in pieces of what lies together: what a camera sees of one is less than its box.
#pragma once

#include <vector>

#include "renderer/scene/scene.h"

namespace si {

/// Triangles that lie together, in their mesh's space.
struct Cluster {
    Bounds box;
    glm::dvec3 axis{0};              ///< unit, about which the triangles' normals lie; 0: they look anywhere
    double spread = 0;               ///< radians that a normal is off it at most
    double lowest = 0, highest = 0;  ///< of corners along the axis
};

/// Which side of its triangles all of a cluster shows.
enum class VisibleSide { Either, Front, Back };

/// @param from in the mesh's space: a point with w of 1, or a direction towards it with w of 0, of any length
VisibleSide visible_side(const Cluster& cluster, const glm::dvec4& from);

/// Clusters that hold every triangle of a mesh between them: one of small meshes, at most some thousand of large ones.
/// Takes time in proportion to the triangles.
std::vector<Cluster> build_clusters(const Mesh& mesh);

/// Indices of large meshes are drawn in runs of so many.
inline constexpr std::size_t kRunIndices = 3 * 1024;
/// Boxes of the runs of a mesh's indices, in its own space; none of a mesh that is too small to be drawn in runs.
std::vector<Bounds> index_run_boxes(const Mesh& mesh);

}  // namespace si
