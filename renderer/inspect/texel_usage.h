// Which texels of a shadow map the picture reads, and which pixels read a texel.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/frame/frame.h"

namespace si {

/// The square of texels that a kernel reads: `count` x `count` from `first` on, v up. It may reach beyond the map,
/// where map.wrap says what is read.
struct KernelFootprint {
    glm::ivec2 first{0};
    int count = 1;
};

/// The texels whose centres lie within `reach_texels` (Reach::read) of the kernel's centre, per axis; of two
/// that lie exactly that far on either side the upper one. These are the texels that the kernels of shaders/filters
/// fetch, whatever weight they give them.
/// @param u, v the kernel's centre in map coordinates
KernelFootprint kernel_footprint(float u, float v, int resolution, double reach_texels);

/// Counts over one layer of a light's map. Texels are counted as in Probe: x to the right, y up.
class TexelUsage {
public:
    TexelUsage() = default;
    /// @param map_coordinates RGBA as FrameResult::map_coordinates has them
    /// @param layer among the light's views: the face
    TexelUsage(const FloatImage& map_coordinates, int resolution, double reach_texels, MapWrap wrap, int layer = 0);

    int resolution() const { return resolution_; }
    /// Share of all texels that at least one pixel's kernel reads.
    double utilisation() const;
    /// Number of pixels whose kernels read the texel.
    std::uint32_t pixels(glm::ivec2 texel) const;
    std::uint32_t max_pixels() const;
    /// One channel: pixels() of each texel, top row first.
    FloatImage counts() const;
    /// The pixels whose kernels read the texel, row 0 at the top, in reading order.
    std::vector<glm::ivec2> readers(glm::ivec2 texel) const;

private:
    int resolution_ = 0, width_ = 0, kernel_ = 1;
    bool repeats_ = false;
    int side_ = 0;  // of the grid of footprints: their first texels, from -(kernel - 1) on, or from 0 where repeated
    std::vector<std::uint32_t> begin_;   // per footprint: its pixels in pixels_
    std::vector<std::uint32_t> pixels_;  // y * width + x, sorted by footprint
    std::vector<std::uint32_t> counts_;  // per texel, bottom row first
    void count_texels();
};

/// The usage under the settings' kernel and map.wrap. @param resolution FrameResult::map_resolution
TexelUsage texel_usage(const FloatImage& map_coordinates, const Settings& settings, int resolution, int layer = 0);

/// Share of the texels that some kernel fetches. @param texels_read FrameResult::texels_read
double exact_utilisation(const FloatImage& texels_read);

}  // namespace si
