// Detection of drivers that draw on the CPU.
#pragma once

#include <string_view>

namespace si {

/// Returns true for an OpenGL driver that draws on the CPU, such as llvmpipe.
/// @param renderer the driver's GL_RENDERER string
bool draws_on_cpu(std::string_view renderer);

/// Returns true when shaders of the current context should read uniform blocks as buffer images, which is faster on CPU
/// drivers (see TexelBuffer).
/// @param renderer the driver's GL_RENDERER string
bool reads_blocks_as_images(std::string_view renderer);

}  // namespace si
