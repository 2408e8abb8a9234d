// What the scene's file and the frame call the things that a setting counts.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/scene/scene.h"

namespace si {

/// Values of a whole-number setting with a name for each; empty: the setting's row says all there is.
using NamedValues = std::vector<std::pair<int, std::string>>;

/// For scene.animation, scene.index and camera.index what the scene and its file hold. Empty for other settings,
/// without a scene, and where there is nothing to choose from.
NamedValues scene_choices(const Scene* scene, std::string_view key);

/// For view.face the shown light's maps by name; a number past the last means the last. Empty for other settings and
/// for lights of a single map.
NamedValues view_choices(const Settings& settings, const FrameResult* result, std::string_view key);

}  // namespace si
