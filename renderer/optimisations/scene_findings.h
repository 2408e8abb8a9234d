// Cache of the scene's mesh boxes and visible objects, which optimisations share between frames.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "renderer/optimisations/visible_objects.h"
#include "renderer/scene/clusters.h"
#include "renderer/scene/per_mesh.h"
#include "renderer/view/culling/needed_maps.h"

namespace si {

/// Bounding boxes of parts of one mesh: of clusters (groups of near triangles) and of runs of consecutive indices. Used
/// to cull parts of large meshes.
struct MeshBoxes {
    std::vector<Cluster> clusters;            ///< build_clusters(); empty until needed
    std::optional<std::vector<Bounds>> runs;  ///< index_run_boxes(); empty until needed
};

/// Cache of the objects that the camera sees, and of the parts of each light's shadow maps (grid cells, MapCells) that
/// the picture reads.
struct CameraMapReads {
    std::uint64_t key = 0;  ///< cache key of camera and scene
    std::optional<VisibleBodies> bodies;
    /// Cells of a grid over one light's shadow maps that look-ups read (NeededMaps). The cache key `key` hashes
    /// everything that these cells depend on.
    struct LightReads {
        std::uint64_t key = 0;
        NeededMaps needed;
    };
    std::array<LightReads, kMaxLights> lights;
};

/// Cache of mesh boxes and of the parts of the scene that the camera sees, each computed on first use. Each renderer
/// has one (Resources::found).
struct SceneFindings {
    PerMeshCache<MeshBoxes> boxes;
    CameraMapReads seen;          ///< objects that the camera sees, and map cells that the picture reads
    VisibleObjects seen_objects;  ///< draw order of the picture
};

/// Returns the clusters of a mesh's triangles (build_clusters()), cached in the renderer. Empty for a mesh that an
/// animation deforms.
/// @param mesh index into Scene::meshes
std::span<const Cluster> mesh_clusters(const FrameState& f, std::size_t mesh);
/// Returns the bounding boxes of runs of consecutive indices of a mesh (index_run_boxes()), cached in the renderer.
/// Empty for a mesh that an animation deforms.
/// @param mesh index into Scene::meshes
std::span<const Bounds> mesh_run_boxes(const FrameState& f, std::size_t mesh);

}  // namespace si
