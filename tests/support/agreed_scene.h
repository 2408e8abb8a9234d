// Declares the scene that all benchmarks draw, in two sizes.
#pragma once

#include "renderer/scene/scene.h"

namespace si::test {

/// Number of triangles of agreed_scene(): 100,088 or 999,810.
enum class AgreedSize { Triangles100k, Triangles1M };

/// Makes the scene of the benchmarks, with the same bytes on every machine. A ground of 40 x 40 m carries 100 boxes, 50
/// spheres and 10 tori in eight flat colours. A camera looks down on them.
Scene agreed_scene(AgreedSize size);

}  // namespace si::test
