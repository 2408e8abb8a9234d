// Names of scenes and files for labels, and names from the scene's file and the frame for whole-number settings.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/scene/scene.h"

namespace si {

/// Returns the label of a scene: a built-in scene's label, or a file's name without folders; "No scene" for an empty
/// name.
std::string scene_label(const std::string& name_or_path);

/// Values of a whole-number setting with their names; empty: plain numbers are shown.
using NamedValues = std::vector<std::pair<int, std::string>>;

/// Returns the choices of a setting that numbers parts of the scene's file, with their names: scene.animation,
/// scene.index or camera.index. Empty for other keys, without a scene, and if there is nothing to choose from.
/// @param key key of the setting
NamedValues scene_choices(const Scene* scene, std::string_view key);

/// Returns the choices of the setting view.face: the views of the shown light (cube faces, cascades), with their names.
/// A view.face beyond the last view is listed too, with the last view's name. Empty for other keys and for lights with
/// a single view.
/// @param key key of the setting
NamedValues view_choices(const Settings& settings, const FrameResult* result, std::string_view key);

}  // namespace si
