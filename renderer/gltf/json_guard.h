// JSON text to a tree, with bounds on depth and size that hold before any memory is spent.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "renderer/gltf/context.h"

namespace si::gltf {

using Json = nlohmann::json;

/// @throws Error on broken JSON (with line and column), nesting beyond 64 or more than 8 million values.
Json parse_json(Context& context, std::string_view text);

/// Rejects what is not glTF 2.x (asset.version, asset.minVersion) and required extensions that are not read here.
void check_asset_and_extensions(Context& context, const Json& root);

/// The text of `root` without extras, extensions, buffers, images, cameras and animations: everything that tinygltf
/// would open, decode or recurse into. What remains is plain data that it can only copy.
std::string core_text(const Json& root);

}  // namespace si::gltf
