// Decoder and encoder of OpenEXR images, for shadow maps. Files are decoded in child processes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/float_image.h"
#include "renderer/foreign/child.h"

namespace si {

/// Decoder of one OpenEXR image, which run_foreign_job() runs in a child process.
extern const ForeignJob kExrJob;

/// Decodes an OpenEXR file with a shadow map in a child process, as the file may be hostile. Reads scanlines or tiles
/// of half, float and whole numbers. Row 0 is the top of the file's data window. At most four channels are returned: Z,
/// Y, R, G, B, A, then others by name. A whole number n becomes n / (2^32 - 1).
/// @throws Error "what is wrong; what to do", without the file's name
FloatImage decode_exr_map(std::span<const std::byte> bytes);

/// Decodes an OpenEXR file in the calling process, and packs the image as bytes for another process. Only the child
/// process of decode_exr_map() calls it.
/// @param progress is called with 0..1
/// @throws Error without the file's name
std::vector<std::uint8_t> decode_packed_exr(std::span<const std::uint8_t> bytes,
                                            const std::function<void(double)>& progress);

/// Encodes the first channel of an image as the bytes of an OpenEXR file: 32-bit floats, channel Y, losslessly
/// compressed. Equal images give equal bytes.
std::string exr_bytes(const FloatImage& image);

}  // namespace si
