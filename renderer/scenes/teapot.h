// The teapot of the lectures.
#pragma once

#include "renderer/scene/scene.h"

namespace si {

/// Newell's teapot from its 32 published bicubic Bezier patches, in the units and at the place of the data (3.15 high,
/// from handle -3 to spout 3.43 along x) but with y up and z towards the front. Its surfaces are open at the lid's rim.
/// @param cells per patch and side
Mesh make_teapot(int cells = 16);

}  // namespace si
