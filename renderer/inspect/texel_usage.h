// Usage of a shadow map's texels: which texels the picture reads, and which pixels read one texel.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/frame/frame.h"

namespace si {

/// Square block of shadow-map texels that a filter kernel reads at one pixel. The block may reach outside the map,
/// where map.wrap applies.
struct KernelFootprint {
    glm::ivec2 first{0};  ///< lower left texel
    int count = 1;        ///< texels per side
};

/// Finds the square block of shadow-map texels that a filter kernel reads at one pixel, including those of weight 0. A
/// texel is read when its centre lies within `reach_texels` of the kernel's centre along both axes. Of two texels
/// exactly at that distance, the upper one is read, as in shaders/filters.
/// @param u, v the kernel's centre in map coordinates, 0..1
/// @param size texels of the map
/// @param reach_texels Reach::read of the kernel
KernelFootprint kernel_footprint(float u, float v, MapSize size, double reach_texels);

/// Number of picture pixels that read each texel of one layer of a light's shadow map. Texels are numbered as in Probe:
/// x to the right, y up.
class TexelUsage {
public:
    TexelUsage() = default;
    /// Counts the picture pixels whose kernels read each texel of a shadow map.
    /// @param map_coordinates four channels, as FrameResult::map_coordinates
    /// @param size texels of the map
    /// @param reach_texels Reach::read of the kernel
    /// @param layer cube face or cascade
    TexelUsage(const FloatImage& map_coordinates, MapSize size, double reach_texels, MapWrap wrap, int layer = 0);

    /// Returns the texels per side of the map.
    MapSize size() const { return size_; }
    /// Returns the share of the shadow map's texels that the kernel of at least one pixel reads, 0..1.
    double utilisation() const;
    /// Returns the number of pixels whose kernels read a texel of the shadow map; 0 outside the map.
    std::uint32_t pixels(glm::ivec2 texel) const;
    /// Returns the largest number of pixels that read the same texel of the shadow map.
    std::uint32_t max_pixels() const;
    /// Returns an image of the shadow map's size whose values are the numbers of picture pixels that read each texel.
    /// One channel, top row first.
    FloatImage counts() const;
    /// Returns the pixels of the picture whose kernels read a texel of the shadow map, in reading order from the top
    /// left.
    std::vector<glm::ivec2> readers(glm::ivec2 texel) const;

private:
    MapSize size_;
    int width_ = 0, kernel_ = 1;
    bool repeats_ = false;
    glm::ivec2 grid_{0};  ///< grid of footprints by first texel, from -(kernel - 1), or from 0 for repeated maps
    std::vector<std::uint32_t> begin_;   ///< per footprint: first index in pixels_
    std::vector<std::uint32_t> pixels_;  ///< y * width + x, sorted by footprint
    std::vector<std::uint32_t> counts_;  ///< per texel, bottom row first
    /// Fills counts_ with the number of picture pixels that read each texel.
    void count_texels();
};

/// Counts the pixels that read each texel of one layer of a shadow map, under the settings' kernel and map.wrap.
/// @param map_coordinates FrameResult::map_coordinates, read back
/// @param size FrameResult::map_size
/// @param layer cube face or cascade
TexelUsage texel_usage(const FloatImage& map_coordinates, const Settings& settings, MapSize size, int layer = 0);

/// Returns the share of a shadow map's texels that at least one kernel fetches, 0..1. Counts only texels that were
/// fetched, whereas TexelUsage counts the whole square around each kernel.
/// @param texels_read FrameResult::texels_read, read back
double exact_utilisation(const FloatImage& texels_read);

}  // namespace si
