// Image of floats in memory.
#pragma once

#include <cstddef>
#include <vector>

namespace si {

/// Image of floats, top row first: read back from the GPU, or decoded from a file.
struct FloatImage {
    int width = 0, height = 0, channels = 1;
    std::vector<float> data;
    /// Returns one channel of one pixel; row 0 is the top.
    float at(int x, int y, int c = 0) const { return data[(std::size_t(y) * width + x) * channels + c]; }
};

}  // namespace si
