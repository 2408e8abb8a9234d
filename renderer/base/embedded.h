// Files of the source tree that the build embeds in the binary.
#pragma once

#include <span>
#include <string_view>

namespace si {

/// One file of the source tree whose text is embedded in the binary, such as a shader.
struct EmbeddedFile {
    std::string_view path;  ///< relative to the source tree, e.g. "shaders/passes/depth.vert.glsl"
    std::string_view text;
};

/// Returns all files that the build embedded in the binary.
std::span<const EmbeddedFile> embedded_files();

}  // namespace si
