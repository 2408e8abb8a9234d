// Names of scenes and files for labels.
#pragma once

#include <string>

namespace si {

/// Returns the label of a scene: a built-in scene's label, or a file's name without folders; "No scene" for an empty
/// name.
std::string scene_label(const std::string& name_or_path);

}  // namespace si
