// Properties of casters (flat sides, content keys) that passes compute once and keep between frames.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/scene/part_identity.h"
#include "renderer/scene/per_mesh.h"

namespace si {

struct FrameState;

/// Flat side of a mesh: a plane that contains triangles facing one direction.
struct MeshSide {
    glm::dvec3 normal, corner;
};
/// Flat sides of one mesh, by which casters are recognised that the light sees edge-on.
struct MeshSides {
    std::vector<MeshSide> sides;  ///< empty: the mesh has too many sides, all of them small
    double least_height = 0;      ///< smallest height of its triangles that have an area, metres
};

/// Cache keys of the depths that the scene's casters draw into a shadow map. Equal keys mean equal depths, so a cached
/// map stays valid.
struct CasterContent {
    std::uint64_t key = 0;  ///< cache key of the scene (Scene::id) and of the settings of its casters
    /// Content key of each instance, in the order of SceneGpu: all that its depths depend on, except the settings
    /// shared by all instances (ReadBy::Maps). 0: the instance never casts.
    std::vector<std::uint64_t> of;
};

/// Keys (hashes) of the content of a mesh without deformation: drawn opaque, and drawn with its alpha mask. 0: not
/// computed yet.
struct RigidMeshKeys {
    std::uint64_t opaque = 0, masked = 0;
};

/// Cache of the content keys (hashes) of casters and textures that earlier frames computed.
struct CasterContentCache {
    /// Texture with the cached hash of its pixels. The hash is part of the cache keys of casters with alpha masks.
    struct TextureContent {
        TextureIdentity texture;
        std::uint64_t content = 0;  ///< 0: not computed yet
    };
    CasterContent casters;
    std::vector<TextureContent> textures;
};

/// Cache of facts about casters: flat sides of meshes, and keys (hashes) of their content. Each is computed when first
/// needed. Each renderer has one (Resources::caster_findings).
struct CasterFindings {
    PerMeshCache<std::optional<MeshSides>> sides;
    PerMeshCache<RigidMeshKeys> rigid_content;
    CasterContentCache content;
};

/// Returns the cache keys of the depths that all casters of the frame's scene draw into shadow maps. They are cached
/// until an object moves or changes. Keys of meshes and textures stay cached even then.
const CasterContent& caster_content(const FrameState& f);

}  // namespace si
