// The agreed scene of the benchmarks: a flat ground of 40 x 40 m with 100 boxes, 50 spheres and 10 tori on and over it,
// in eight flat colours, without textures, seen from above. The same bytes on every machine.
#pragma once

#include "renderer/scene/scene.h"

namespace si::test {

enum class AgreedSize { Triangles100k, Triangles1M };  ///< 100,088 and 999,810

Scene agreed_scene(AgreedSize size);

}  // namespace si::test
