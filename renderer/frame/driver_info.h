// Abilities and measured traits of the OpenGL driver.
#pragma once

#include <string>
#include <vector>

#include "renderer/gl/raster_traits.h"

namespace si {

/// Abilities, limits and measured traits of one OpenGL driver, from query_driver() and calibration.
struct DriverInfo : RasterTraits {
    std::string vendor, renderer, version, glsl;
    int max_texture_size = 0, max_samples = 0;
    bool polygon_offset_clamp = false, anisotropy = false;
    double max_anisotropy = 1;
    std::vector<int> map_samples;   ///< sample counts possible for depth textures, largest first
    bool software = false;          ///< a CPU rasteriser
    bool blocks_as_images = false;  ///< shaders read single numbers faster from images than from uniform blocks
    std::string clock;              ///< name of the clock of passes, as gl::name() gives it
    double query_share = 0;         ///< timer query's time / wall time of the calibration pass
};

}  // namespace si
