// Names from the scene's file and the frame for values of whole-number settings.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/scene/scene.h"

namespace si {

/// Values of a whole-number setting with their names; empty: plain numbers are shown.
using NamedValues = std::vector<std::pair<int, std::string>>;

/// Returns the animations, scenes or cameras of the file for scene.animation, scene.index or camera.index. Empty for
/// other settings, without a scene, and if there is nothing to choose from.
NamedValues scene_choices(const Scene* scene, std::string_view key);

/// Returns the shown light's views (faces, cascades) for view.face; a number past the last means the last. Empty for
/// other settings and for lights with a single view.
NamedValues view_choices(const Settings& settings, const FrameResult* result, std::string_view key);

}  // namespace si
