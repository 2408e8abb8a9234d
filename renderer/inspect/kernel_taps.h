// The texels that a kernel compares and what each weighs: shaders/filters in double, for one pixel.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/settings/techniques.h"

namespace si {

struct KernelTexel {
    glm::ivec2 texel{0};  ///< x to the right, y up; may lie outside of the map
    double weight = 0;    ///< share of the kernel's result; all of a kernel's sum to 1
};

/// Row by row from the lowest, footprint_width() texels a row. A bilinear kernel weighs the texels of its border by
/// where the centre lies between them; a weight may be 0.
/// @param centre of the kernel, in texels from the map's corner
std::vector<KernelTexel> kernel_texels(const Filter& filter, const glm::dvec2& centre);

/// Texels a row: the kernel's size, and one more for bilinear ones.
int footprint_width(const Filter& filter);

}  // namespace si
