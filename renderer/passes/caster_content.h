// What casters are, whichever scene they are of: by it what is drawn of them outlasts what moves elsewhere.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/frame/state.h"
#include "renderer/scene/part_identity.h"

namespace si {

struct CasterContent {
    std::uint64_t key = 0;  ///< of the scene's arrangement
    /// By instance as SceneGpu orders them, a key of all that its depths in a map come of, but for the settings that
    /// are alike for all (ReadBy::Maps); 0: it never casts.
    std::vector<std::uint64_t> of;
};

/// Of a rigid mesh; 0: not found yet.
struct RigidMeshKeys {
    std::uint64_t opaque = 0, masked = 0;
};

struct CasterContentCache {
    struct OfTexture {
        TextureIdentity texture;
        std::uint64_t content = 0;  ///< 0: not found yet
    };
    CasterContent casters;
    std::vector<OfTexture> textures;
};

/// Found once for each arrangement of a scene; meshes and textures that poses share once for all of these.
const CasterContent& caster_content(const FrameState& f);

}  // namespace si
