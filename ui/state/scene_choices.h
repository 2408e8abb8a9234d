// What the scene's file calls the things that a setting counts.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/scene/scene.h"

namespace si {

/// Values of a whole-number setting with a name for each; empty: the setting's row says all there is.
using NamedValues = std::vector<std::pair<int, std::string>>;

/// For scene.animation, scene.index and camera.index what the scene and its file hold. Empty for other settings,
/// without a scene, and where there is nothing to choose from.
NamedValues scene_choices(const Scene* scene, std::string_view key);

}  // namespace si
