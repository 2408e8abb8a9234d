// Reasons why an image file cannot be decoded, found in the file itself: stb_image keeps one text per thread, which may
// be absent or belong to an earlier image.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace si::gltf {

/// Returns why an image file that stb_image refuses cannot be decoded, as a clause: "the PNG is cut inside its chunk
/// IDAT". Follows the chunks of a PNG or the segments of a JPEG to the first fault; without one, the compressed data is
/// damaged.
std::string image_fault(std::span<const std::uint8_t> bytes);

}  // namespace si::gltf
