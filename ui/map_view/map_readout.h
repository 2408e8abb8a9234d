// What the map viewer says of the texel under the mouse.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <utility>

#include "renderer/frame/frame.h"
#include "renderer/inspect/texel_usage.h"

namespace si {

/// Two lines: the texel and who reads it; its depth in metres, as stored, and linear between the planes.
/// @param texel y up, of a depth image of `size` texels
/// @param values the stored depths, row 0 at the top; null or of another size: not read back yet
/// @param shown whether they are moments instead: then what is said is the moment, or in the linear view the depth that
/// alone would have it; of a mip level, `values` have that level's size
/// @param usage may be null; `frozen`: the readers are the frozen camera's pixels
std::pair<std::string, std::string> texel_readout(glm::ivec2 texel, glm::ivec2 size, const FloatImage* values,
                                                  const DepthCurve& curve, const TexelUsage* usage, bool frozen,
                                                  const ShownMap& shown = {}, bool linear = false);

}  // namespace si
