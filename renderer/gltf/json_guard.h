// JSON parser with limits on depth and size that are checked before memory is allocated.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "renderer/gltf/context.h"

namespace si::gltf {

using Json = nlohmann::json;

/// Parses the JSON text of a glTF file.
/// @throws Error on invalid JSON (with line and column), nesting above 64 or more than 8 million values
Json parse_json(Context& context, std::string_view text);

/// Checks that a glTF document has version 2.x and requires only extensions that this loader reads.
/// @throws Error naming version or extension
void check_asset_and_extensions(Context& context, const Json& root);

/// Serialises a glTF document for tinygltf, without extras, extensions, buffers, images, cameras and animations. These
/// are the parts that tinygltf would open, decode or recurse into; the rest is plain data that it copies.
std::string core_text(const Json& root);

}  // namespace si::gltf
