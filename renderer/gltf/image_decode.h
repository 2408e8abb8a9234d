// Decoding of PNG and JPEG images.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace si::gltf {

/// Decoded image with 8-bit RGBA pixels, or the reason why it could not be decoded.
struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
    std::string error;  ///< empty: decoded
};

/// Decodes a PNG or JPEG file in memory to RGBA8 (stb_image). Failures are reported in Image::error.
Image decode_image(std::span<const std::uint8_t> bytes);
/// Estimates the peak memory of decode_image() in bytes from the image's header, to refuse images that are too large. 0
/// when the header is unreadable.
std::size_t decoding_bytes(std::span<const std::uint8_t> bytes);

}  // namespace si::gltf
