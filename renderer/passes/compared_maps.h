// Binding of the shadow maps that shaders compare with.
#pragma once

#include "renderer/frame/state.h"

namespace si {

/// Binds a texture array as the frame's shadow maps, to its unit for reading depths and, unless depths are stored as
/// colour, to the unit of the comparing sampler.
void place_compared_maps(FrameState& f, const gl::Target& maps);

}  // namespace si
