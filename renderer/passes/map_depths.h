// Shadow maps read back.
#pragma once

#include <vector>

#include "renderer/frame/state.h"

namespace si {

class PagePasses;

/// Which layer of the shadow maps is whose, and how they are kept.
struct MapLayer {
    DepthCurve curve;
    int layer = 0;
    bool paged = false, holds_distances = false;
};

/// Depths of a part of a layer of the maps, bottom row first, whatever the maps are kept in.
std::vector<float> read_map_depths(const PagePasses& pages, const gl::Target& maps, const MapLayer& of,
                                   glm::ivec2 first, glm::ivec2 size);

}  // namespace si
