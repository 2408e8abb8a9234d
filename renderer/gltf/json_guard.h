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

/// Checks that a glTF document has version 2.x and that this loader reads all required extensions. Extensions that
/// change only the look of surfaces give a warning instead of an error.
/// @param root the document @throws Error naming the version or the extension
void check_asset_and_extensions(Context& context, const Json& root);

/// Returns a member of a JSON object. Null when the member is absent, or when `object` is null or not an object.
const Json* member(const Json* object, const char* key);

/// Returns the extension with this name of a glTF object; null when the object does not have it.
const Json* extension_of(const Json& object, const char* name);

/// Returns a string member of a JSON object. Empty when the member is absent or not a string.
std::string text_member(const Json& object, const char* key);

/// Returns a member of a JSON object as an index; nullopt when the member is absent, not a whole number, or not below
/// `size`.
std::optional<std::size_t> index_member(const Json& object, const char* key, std::size_t size);

/// Returns true when a JSON value is a number from `least` to `most`.
bool is_number_within(const Json& value, double least, double most);

/// Serialises a glTF document for tinygltf, without extras, extensions, buffers, images, cameras and animations.
/// tinygltf would open, decode or recurse into these parts; it only copies the rest.
std::string core_text(const Json& root);

}  // namespace si::gltf
