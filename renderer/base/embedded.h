// Files of the source tree that travel inside the binary.
#pragma once

#include <span>
#include <string_view>

namespace si {

struct EmbeddedFile {
    std::string_view path;  ///< relative to the source tree, e.g. "shaders/passes/depth.vert.glsl"
    std::string_view text;
};

std::span<const EmbeddedFile> embedded_files();

}  // namespace si
