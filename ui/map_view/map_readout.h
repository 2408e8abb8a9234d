// Text of the map viewer about the texel under the mouse.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <utility>

#include "renderer/frame/frame.h"
#include "renderer/inspect/texel_usage.h"

namespace si {

/// Formats the map viewer's text about one texel. The first line names the texel and the pixels that read it. The
/// second gives its depth in metres, as stored, and as a share between the planes.
/// @param texel the texel, y up, of a depth image of `size` texels
/// @param values the stored depths, row 0 at the top; null or of another size: not read back yet
/// @param shown the kind of image: for moments the text gives the moment, or in the linear view the depth with that
/// moment; at a mip level `values` have that level's size
/// @param usage texels that pixels read; null: not known @param frozen true: the readers are the frozen camera's pixels
std::pair<std::string, std::string> texel_readout(glm::ivec2 texel, glm::ivec2 size, const FloatImage* values,
                                                  const DepthCurve& curve, const TexelUsage* usage, bool frozen,
                                                  const ShownMap& shown = {}, bool linear = false);

}  // namespace si
