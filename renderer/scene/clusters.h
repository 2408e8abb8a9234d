// Clusters of neighbouring triangles of large meshes, for tighter visibility tests than the mesh's box allows.
#pragma once

#include <vector>

#include "renderer/scene/scene.h"

namespace si {

/// Bounding box and normal cone of a group of neighbouring triangles, in the space of their mesh. Used to test the
/// visibility of the whole group.
struct Cluster {
    Bounds box;
    glm::dvec3 axis{0};              ///< unit axis of the normal cone; 0: normals in all directions
    double spread = 0;               ///< half angle of the normal cone, radians
    double lowest = 0, highest = 0;  ///< extent of the triangles' corners along the axis
};

/// Side that all triangles of a cluster turn to a viewer; Either: unknown, or not the same for all.
enum class VisibleSide { Either, Front, Back };

/// Returns the side, front or back, that all triangles of a cluster turn to a viewer or light. Returns
/// VisibleSide::Either when the normal cone cannot tell. Used to skip clusters as a whole.
/// @param from position of the viewer or light in the mesh's space, with w of 1; or the direction towards it, of any
/// length, with w of 0
VisibleSide visible_side(const Cluster& cluster, const glm::dvec4& from);

/// Splits a mesh into clusters of neighbouring triangles, for visibility tests. Small meshes give one cluster, large
/// ones at most some thousand. Takes linear time.
std::vector<Cluster> build_clusters(const Mesh& mesh);

/// Number of indices in one run: large meshes are drawn and culled in runs of this length.
inline constexpr std::size_t kRunIndices = 3 * 1024;
/// Returns the bounding box, in the mesh's space, of each run of kRunIndices consecutive indices. Large meshes are
/// drawn and culled in such runs. Empty for a mesh of fewer than two runs.
std::vector<Bounds> index_run_boxes(const Mesh& mesh);

}  // namespace si
