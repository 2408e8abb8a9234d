// Abilities and measured traits of the OpenGL driver.
#pragma once

#include <string>
#include <vector>

#include "renderer/gl/raster_traits.h"

namespace si {

/// What this driver can do, and what was measured on it.
struct DriverInfo : RasterTraits {
    std::string vendor, renderer, version, glsl;
    int max_texture_size = 0, max_samples = 0;
    bool polygon_offset_clamp = false, anisotropy = false;
    double max_anisotropy = 1;
    std::vector<int> map_samples;   ///< that a multisampled depth texture can have, the most first
    bool software = false;          ///< a CPU rasteriser
    bool blocks_as_images = false;  ///< prefers to read single numbers from images rather than uniform blocks
    std::string clock;              ///< "GPU timer queries" or "finished wall time (CPU rasteriser)"
    double query_share = 0;         ///< query time / wall time of a known pass
};

}  // namespace si
