// Checks that the decoders of all formats of shadow maps share, before they take memory.
#pragma once

#include <cstddef>
#include <cstdint>

namespace si {

/// Checks width and height of a shadow map's image, before memory is taken for it.
/// @throws Error without the file's name, for a side below 1 or above kMaxBundleImageSide
void check_map_image_sides(std::int64_t width, std::int64_t height);
/// Checks the size of a shadow map's image, before memory is taken for it.
/// @throws Error without the file's name, if all channels together have more than `most` numbers
void check_map_image_numbers(std::int64_t width, std::int64_t height, int channels, std::size_t most);

}  // namespace si
