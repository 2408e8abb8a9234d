// Read-back of a frame's images, top row first.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "renderer/frame/frame.h"

namespace si {

/// Turns an image upside down in place; OpenGL has its bottom row first.
/// @param channels numbers per pixel
template <typename T>
void flip_rows(std::vector<T>& data, int width, int height, int channels) {
    const std::ptrdiff_t row = std::ptrdiff_t(width) * channels;
    for (int y = 0; y < height / 2; ++y)
        std::swap_ranges(data.begin() + y * row, data.begin() + (y + 1) * row, data.begin() + (height - 1 - y) * row);
}

/// Reads back a texture as floats, top row first.
/// @param channels 1 to 4, from red on
FloatImage read_floats(const Image& image, int channels);
/// Reads back the object and triangle numbers of all pixels, top row first.
/// @param image FrameResult::surface_ids
SurfaceIds read_ids(const Image& image);

}  // namespace si
