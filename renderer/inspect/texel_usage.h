// Usage of a shadow map's texels: which texels the picture reads, and which pixels read one texel.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/frame/frame.h"

namespace si {

/// Square of texels that a shadow kernel reads at one pixel. The square may reach outside the map, where map.wrap
/// applies.
struct KernelFootprint {
    glm::ivec2 first{0};  ///< lower left texel
    int count = 1;        ///< texels per side
};

/// Computes the square of texels that a shadow kernel reads, whatever their weights: centres within `reach_texels` of
/// the kernel's centre, per axis. Of two texels exactly at that distance, the upper one counts, as in shaders/filters.
/// @param u, v the kernel's centre in map coordinates, 0..1
/// @param size texels of the map
/// @param reach_texels Reach::read
KernelFootprint kernel_footprint(float u, float v, MapSize size, double reach_texels);

/// Number of pixels that read each texel of one layer of a light's shadow map. Texels are counted as in Probe: x to the
/// right, y up.
class TexelUsage {
public:
    TexelUsage() = default;
    /// Counts the pixels that read each texel.
    /// @param map_coordinates four channels, as FrameResult::map_coordinates
    /// @param size texels of the map
    /// @param reach_texels Reach::read of the kernel
    /// @param layer cube face or cascade
    TexelUsage(const FloatImage& map_coordinates, MapSize size, double reach_texels, MapWrap wrap, int layer = 0);

    /// Returns the texels per side of the map.
    MapSize size() const { return size_; }
    /// Returns the share of all texels that at least one pixel's kernel reads.
    double utilisation() const;
    /// Returns the number of pixels whose kernels read a texel; 0 outside the map.
    std::uint32_t pixels(glm::ivec2 texel) const;
    /// Returns the largest number of pixels that read one texel.
    std::uint32_t max_pixels() const;
    /// Returns an image with a pixel for each texel of the map: the number of picture pixels whose kernels read it. One
    /// channel, top row first.
    FloatImage counts() const;
    /// Returns the pixels whose kernels read a texel, in reading order from the top left.
    std::vector<glm::ivec2> readers(glm::ivec2 texel) const;

private:
    MapSize size_;
    int width_ = 0, kernel_ = 1;
    bool repeats_ = false;
    glm::ivec2 grid_{0};  ///< grid of footprints by first texel, from -(kernel - 1), or from 0 for repeated maps
    std::vector<std::uint32_t> begin_;   ///< per footprint: first index in pixels_
    std::vector<std::uint32_t> pixels_;  ///< y * width + x, sorted by footprint
    std::vector<std::uint32_t> counts_;  ///< per texel, bottom row first
    /// Fills counts_ with the number of pixels that read each texel.
    void count_texels();
};

/// Computes the texel usage of a map under the kernel and map.wrap of the settings.
/// @param map_coordinates FrameResult::map_coordinates, read back
/// @param resolution FrameResult::map_size
/// @param layer cube face or cascade
TexelUsage texel_usage(const FloatImage& map_coordinates, const Settings& settings, MapSize size, int layer = 0);

/// Returns the share of a map's texels that at least one kernel fetches, exactly instead of by bounding squares.
/// @param texels_read FrameResult::texels_read, read back
double exact_utilisation(const FloatImage& texels_read);

}  // namespace si
