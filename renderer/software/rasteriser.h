// Drivers that draw on the CPU, and the way in which their shaders read numbers fastest.
#pragma once

#include <string_view>

namespace si {

/// Returns whether a driver draws on the CPU. @param renderer GL_RENDERER
bool draws_on_cpu(std::string_view renderer);

/// Returns whether shaders of the current context read single numbers from images (see TexelBuffer).
/// @param renderer GL_RENDERER
bool reads_blocks_as_images(std::string_view renderer);

}  // namespace si
