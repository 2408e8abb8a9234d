// Checks that the decoders of all formats of shadow maps share, before they take memory.
#pragma once

#include <cstddef>
#include <cstdint>

namespace si {

/// Checks the sides of an image. @throws Error without the file's name, for a side below 1 or above kMaxBundleImageSide
void check_map_image_sides(std::int64_t width, std::int64_t height);
/// Checks how many numbers all channels of an image have. @throws Error without the file's name, for more than `most`
void check_map_image_numbers(std::int64_t width, std::int64_t height, int channels, std::size_t most);

}  // namespace si
