// The scenes that ship with the program, made in code.
#pragma once

#include <span>
#include <string_view>

#include "renderer/gltf/gltf.h"
#include "renderer/scene/scene.h"

namespace si {

struct BuiltinScene {
    std::string_view key, label, help;
    Scene (*make)();
};

/// The first row is the default scene.
std::span<const BuiltinScene> builtin_scenes();

/// Whether load_scene() makes it without a file: a row above, or a hard case ("hard/grazing").
bool is_builtin_scene(std::string_view name);

/// A built-in scene by key, a hard case by name, or a .gltf/.glb file by path. `options` are for files; built-in scenes
/// take a moment and report nothing. @throws Error naming file, place and remedy.
Scene load_scene(std::string_view name_or_path, const GltfOptions& options = {});

}  // namespace si
