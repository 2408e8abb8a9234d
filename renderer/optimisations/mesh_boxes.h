// Bounding boxes of parts of meshes, computed on first use.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "renderer/frame/state.h"
#include "renderer/scene/clusters.h"

namespace si {

/// Returns the clusters of a mesh's triangles (build_clusters()), cached in the renderer; empty for a mesh that is
/// deformed by the pose.
/// @param mesh index into Scene::meshes
std::span<const Cluster> mesh_clusters(const FrameState& f, std::size_t mesh);
/// Returns the bounding boxes of runs of a mesh's indices (index_run_boxes()), cached in the renderer; empty for a mesh
/// that is deformed by the pose.
/// @param mesh index into Scene::meshes
std::span<const Bounds> mesh_run_boxes(const FrameState& f, std::size_t mesh);

}  // namespace si
