// Read-back of shadow maps.
#pragma once

#include <vector>

#include "renderer/frame/state.h"

namespace si {

class PagePasses;

/// Layer of the shadow map textures that read_map_depths() reads, with its storage and depth curve.
struct MapLayer {
    DepthCurve curve;
    int layer = 0;
    bool paged = false, holds_distances = false;
};

/// Reads back stored depths of a rectangle of one shadow map layer, bottom row first. Works for depth formats, colour
/// formats and virtual maps.
/// @param first lower left texel
/// @param size width and height in texels
std::vector<float> read_map_depths(const PagePasses& pages, const gl::Target& maps, const MapLayer& of,
                                   glm::ivec2 first, glm::ivec2 size);

}  // namespace si
