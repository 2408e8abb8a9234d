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

/// Plane that contains triangles of a mesh: its unit normal, and a corner of one triangle, in mesh space.
struct MeshPlane {
    glm::dvec3 normal, corner;
};
/// Directions and planes of a mesh's triangles in mesh space, by which casters are found that the light sees edge-on.
struct MeshSides {
    std::vector<glm::dvec3> normals;  ///< differing unit normals; empty: too many to test, or no triangle has an area
    std::vector<MeshPlane> planes;    ///< differing planes; parallel ones, such as the steps of stairs, are separate
    bool has_all_planes = true;       ///< false: there are more planes than `planes` lists
    double least_height = 0;          ///< smallest height of a triangle, mesh space; 0 if any triangle is degenerate
};

/// Cache keys of the depths that the scene's casters draw into a shadow map. Equal keys mean equal depths, so a cached
/// map stays valid.
struct CasterContent {
    std::uint64_t key = 0;  ///< cache key of the scene (Scene::id) and of the settings of its casters
    /// Content key of each instance, by index in SceneGpu::instance_objects(): all that the instance's depths depend
    /// on, except the settings shared by all instances (ReadBy::Maps). 0: the instance never casts.
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

/// Cache of facts about casters: directions that triangles of meshes face, and keys (hashes) of casters' content. Each
/// fact is computed when first needed. Each renderer has one cache (Resources::caster_findings).
struct CasterFindings {
    PerMeshCache<std::optional<MeshSides>> sides;
    PerMeshCache<RigidMeshKeys> rigid_content;
    CasterContentCache content;
};

/// Returns the cache keys of the depths that all casters of the frame's scene draw into shadow maps. They are cached
/// until an object moves or changes. Keys of meshes and textures stay cached even then.
const CasterContent& caster_content(const FrameState& f);

}  // namespace si
