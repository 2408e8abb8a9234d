// JSON parser with limits on depth and size that are checked before memory is allocated.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
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

/// Returns a member of a JSON object; null when it is absent, or when `object` is null or no object.
const Json* member(const Json* object, const char* key);

/// Returns an extension of a glTF object; null when the object has none of this name.
const Json* extension_of(const Json& object, const char* name);

/// Returns a member of a JSON object that is a string; empty when it is none.
std::string text_member(const Json& object, const char* key);

/// Returns a member of a JSON object that is an index below `size`; nothing when it is none.
std::optional<std::size_t> index_member(const Json& object, const char* key, std::size_t size);

/// Returns true when a JSON value is a number from `least` to `most`.
bool is_number_within(const Json& value, double least, double most);

/// Serialises a glTF document for tinygltf, without extras, extensions, buffers, images, cameras and animations. These
/// are the parts that tinygltf would open, decode or recurse into; the rest is plain data that it copies.
std::string core_text(const Json& root);

}  // namespace si::gltf
