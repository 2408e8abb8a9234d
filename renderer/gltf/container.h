// Container of a glTF file: plain JSON, or the chunks of a GLB.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "renderer/gltf/context.h"

namespace si::gltf {

/// JSON text and binary chunk of a glTF file; both point into the file's bytes.
struct Container {
    std::string_view json;
    std::span<const std::uint8_t> bin;
    bool has_bin = false;
};

/// Splits the bytes of a glTF file into JSON and binary chunk. Recognises GLB by its first bytes, not by the file's
/// name, and validates every length (glTF 2.0, section 4).
/// @throws Error when the file is neither JSON nor GLB, or a chunk extends beyond the end of the file
Container split_container(Context& context, std::span<const std::uint8_t> file);

}  // namespace si::gltf
