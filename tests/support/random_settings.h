// Draws random settings over the whole range of every setting, degenerate values included.
#pragma once

#include <string>

#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"

namespace si::test {

/// Scene and random settings of one test case.
struct RandomCase {
    std::string scene;  ///< key of a built-in scene
    Settings settings;
};

/// Returns the random case of a seed, which is the same on every machine. kSeedsPerProgram consecutive seeds share the
/// settings that select shader programs, because compiling takes longer than drawing.
RandomCase random_case(unsigned seed);
/// Number of consecutive seeds that share their shader programs.
inline constexpr unsigned kSeedsPerProgram = 25;

/// Returns a small built-in scene by its key. The first call for a key loads the scene.
const Scene& small_scene(const std::string& key);

}  // namespace si::test
