// Keys of casters by their content, independent of the scene object. Cached map contents stay valid while other objects
// move.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/frame/state.h"
#include "renderer/scene/part_identity.h"

namespace si {

/// Content keys of all casters in one arrangement of a scene.
struct CasterContent {
    std::uint64_t key = 0;  ///< key of the scene's arrangement (SceneGpu::key())
    /// Key by instance, in the order of SceneGpu: everything its depths in a map depend on. Excluded are settings equal
    /// for all casters (ReadBy::Maps). 0: never casts.
    std::vector<std::uint64_t> of;
};

/// Content keys of a rigid mesh, for opaque and for masked use; 0: not computed yet.
struct RigidMeshKeys {
    std::uint64_t opaque = 0, masked = 0;
};

/// Cache of caster content keys between frames.
struct CasterContentCache {
    /// Content key of one texture.
    struct OfTexture {
        TextureIdentity texture;
        std::uint64_t content = 0;  ///< 0: not computed yet
    };
    CasterContent casters;
    std::vector<OfTexture> textures;
};

/// Returns the content keys of all casters in the frame's scene. Keys are computed once for each arrangement; keys of
/// meshes and textures are shared by all poses.
const CasterContent& caster_content(const FrameState& f);

}  // namespace si
