// Newell's teapot.
#pragma once

#include "renderer/scene/scene.h"

namespace si {

/// Makes Newell's teapot from its 32 published bicubic Bezier patches, with y up and z towards the front. Units and
/// position are those of the data: 3.15 high, from the handle at x = -3 to the spout at x = 3.43. The mesh is open at
/// the lid's rim.
/// @param cells subdivisions of a patch along each side
Mesh make_teapot(int cells = 16);

}  // namespace si
