// Reasons why an image file cannot be decoded, found in the file itself: stb_image keeps one text per thread, which may
// be absent or belong to an earlier image.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace si::gltf {

/// Explains why stb_image cannot decode an image file, as a clause such as "the PNG is cut inside its chunk IDAT".
/// Searches the chunks of a PNG or the segments of a JPEG for the first fault. If there is none, the clause blames the
/// compressed data.
std::string image_fault(std::span<const std::uint8_t> bytes);

/// Explains which chunk of a PNG file has a wrong checksum, as a clause; empty: none, or the file is no PNG. Checks
/// only chunks on which pixels depend. The decoder ignores checksums. Used where pixels are compared, since a damaged
/// file may decode to wrong pixels.
std::string checksum_fault(std::span<const std::uint8_t> bytes);

}  // namespace si::gltf
