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

/// Reads a texture of a frame back from the GPU as floats, top row first.
/// @param channels number of channels to read, 1 (red) to 4
FloatImage read_floats(const Image& image, int channels);
/// Reads the object and triangle numbers of all pixels back from the GPU, top row first.
/// @param image FrameResult::surface_ids
SurfaceIds read_ids(const Image& image);

}  // namespace si
