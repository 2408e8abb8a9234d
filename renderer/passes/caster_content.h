// Keys of casters by their content, independent of the scene object. Cached map contents stay valid while other objects
// move.
#pragma once

#include "renderer/frame/state.h"
#include "renderer/passes/caster_findings.h"

namespace si {

/// Returns the content keys of all casters in the frame's scene. They are cached until an object moves or changes; keys
/// of meshes and textures stay cached then too.
const CasterContent& caster_content(const FrameState& f);

}  // namespace si
