// Facts that optimisations find of a scene once and keep between frames.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "renderer/optimisations/visible_objects.h"
#include "renderer/scene/clusters.h"
#include "renderer/scene/per_mesh.h"
#include "renderer/view/culling/needed_maps.h"

namespace si {

/// Boxes around parts of one mesh: clusters of triangles, and runs of indices.
struct BoxesOfMesh {
    std::vector<Cluster> clusters;
    std::optional<std::vector<Bounds>> runs;  ///< none: not built yet
};

/// Parts of each light's maps that the camera reads, kept until camera, scene or maps change.
struct SeenFromCamera {
    std::uint64_t key = 0;
    std::optional<SeenBodies> bodies;
    /// Parts of one light's maps.
    struct OfLight {
        std::uint64_t key = 0;
        NeededMaps called;
    };
    std::array<OfLight, kMaxLights> lights;
};

/// Boxes of meshes and the parts that the camera sees, each found when first needed. One object a renderer
/// (Resources::found).
struct SceneFindings {
    OfMeshes<BoxesOfMesh> boxes;
    SeenFromCamera seen;
    SeenObjects seen_objects;
};

}  // namespace si
