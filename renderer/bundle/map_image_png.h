// Decoder of PNG images of 16 bits, for shadow maps.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "renderer/base/float_image.h"

namespace si {

/// Decodes a PNG file with a shadow map of 16 bits a channel. A stored number n becomes n / 65535. Row 0 is the first
/// row of the file.
/// @throws Error "what is wrong; what to do", without the file's name
FloatImage decode_png_map(std::span<const std::byte> bytes);

}  // namespace si
