// Images of a frame read back, top row first.
#pragma once

#include "renderer/frame/frame.h"

namespace si {

/// @param channels 1 to 4, from red on
FloatImage read_floats(const Image& image, int channels);
/// Of FrameResult::surface_ids.
SurfaceIds read_ids(const Image& image);

}  // namespace si
