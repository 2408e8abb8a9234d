// Settings by chance, over the whole range of every row, degenerate values included.
#pragma once

#include <string>

#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"

namespace si::test {

struct RandomCase {
    std::string scene;  ///< a built-in one
    Settings settings;
};

/// The same number gives the same case everywhere. What programs are made of is shared by as many neighbours as
/// kSeedsPerProgram: a CPU rasteriser takes far longer to make one than to draw with it.
RandomCase random_case(unsigned seed);
inline constexpr unsigned kSeedsPerProgram = 25;

/// A small scene that cases are of, read once.
const Scene& small_scene(const std::string& key);

}  // namespace si::test
