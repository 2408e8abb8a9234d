// Decoding of the images of shadow maps: .pfm, .exr, .png of 16 bits, and raw texels.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "renderer/base/float_image.h"
#include "renderer/bundle/bundle.h"

namespace si {

/// Layout of a shadow map in a raw file, which does not state it. Ignored for other file formats.
struct MapImageFormat {
    int width = 0, height = 0;  ///< texels
    int channels = 1;           ///< numbers per texel
    std::optional<RawFormat> format;
};

/// Decodes the image file of a shadow map. The extension of its name tells the format. All channels are returned. Rows
/// stay in the order of the file: row 0 of the result is the first stored row. Integers of n bits become value / (2^n -
/// 1).
/// @param file_name for the extension and for messages
/// @param bytes content of the file
/// @param raw layout of a .raw file
/// @throws Error "FILE: what is wrong; what to do"; sizes are checked before memory is taken
FloatImage decode_map_image(std::string_view file_name, std::span<const std::byte> bytes, const MapImageFormat& raw);

}  // namespace si
