// Text of the map viewer about the texel under the mouse.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <utility>

#include "renderer/frame/frame.h"
#include "renderer/inspect/texel_usage.h"

namespace si {

/// Returns two lines: the texel and its readers; its depth in metres, as stored, and linear between the planes.
/// @param texel y up, of a depth image of `size` texels
/// @param values the stored depths, row 0 at the top; null or of another size: not read back yet
/// @param shown moments instead of depths: the text is the moment, or in the linear view the depth with that moment. At
/// a mip level, `values` have that level's size
/// @param usage null: not known @param frozen the readers are the frozen camera's pixels
std::pair<std::string, std::string> texel_readout(glm::ivec2 texel, glm::ivec2 size, const FloatImage* values,
                                                  const DepthCurve& curve, const TexelUsage* usage, bool frozen,
                                                  const ShownMap& shown = {}, bool linear = false);

}  // namespace si
