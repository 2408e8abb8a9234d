// The outer shell of a glTF file: plain JSON, or the chunks of a GLB.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "renderer/gltf/context.h"

namespace si::gltf {

struct Container {
    std::string_view json;
    std::span<const std::uint8_t> bin;
    bool has_bin = false;
    bool is_glb = false;
};

/// Tells GLB from JSON by its first bytes, not by the file's name, and checks every length (glTF 2.0, section 4).
/// @throws Error when it is neither, or a chunk passes the end of the file.
Container split_container(Context& context, std::span<const std::uint8_t> file);

}  // namespace si::gltf
