// Detection of drivers that draw on the CPU.
#pragma once

#include <string_view>

namespace si {

/// Returns true for a driver that draws on the CPU.
/// @param renderer GL_RENDERER
bool draws_on_cpu(std::string_view renderer);

/// Returns true when shaders of the current context should read uniform blocks as images, which is faster on CPU
/// drivers (see TexelBuffer).
/// @param renderer GL_RENDERER
bool reads_blocks_as_images(std::string_view renderer);

}  // namespace si
