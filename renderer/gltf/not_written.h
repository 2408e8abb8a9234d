// Parts of a glTF file that an export of its scene lacks.
#pragma once

#include <string>
#include <vector>

#include "renderer/gltf/json_guard.h"

namespace si::gltf {

/// Lists the parts of a glTF file that are lost when its scene is saved by save_gltf(), one sentence each. Scene has no
/// fields for these parts: extensions, properties of materials, formats of images, extras and the copyright.
/// @param root JSON of the file
std::vector<std::string> parts_not_written(const Json& root);

}  // namespace si::gltf
