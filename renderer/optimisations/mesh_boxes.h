// Boxes about parts of meshes, found when first asked for.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "renderer/frame/state.h"
#include "renderer/scene/clusters.h"

namespace si {

/// See build_clusters(); none of a mesh that changes with the pose.
std::span<const Cluster> clusters_of_mesh(const FrameState& f, std::size_t mesh);
/// See index_run_boxes(); none of a mesh that changes with the pose.
std::span<const Bounds> run_boxes_of_mesh(const FrameState& f, std::size_t mesh);

}  // namespace si
