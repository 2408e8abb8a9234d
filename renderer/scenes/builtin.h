// Table of the built-in scenes, which are made in code.
#pragma once

#include <span>
#include <string_view>

#include "renderer/gltf/gltf.h"
#include "renderer/scene/scene.h"

namespace si {

/// Row of the table of built-in scenes: names for command line and menu, and the function that makes the scene.
struct BuiltinScene {
    std::string_view key, label, help;
    Scene (*make)();
};

/// Returns the table of built-in scenes; the first row is the default scene.
std::span<const BuiltinScene> builtin_scenes();

/// Returns true when `name` is the key of a built-in scene or the name of a hard case (a situation in which shadow maps
/// break), such as "hard/grazing". load_scene() then reads no file.
bool is_builtin_scene(std::string_view name);

/// Loads a scene: a built-in scene by key, a hard case (a situation in which shadow maps break) by name, or a model
/// file by path (importers()).
/// @param options the options for files; built-in scenes ignore them and report no progress
/// @throws Error naming file, place and fix
Scene load_scene(std::string_view name_or_path, const GltfOptions& options = {});

}  // namespace si
