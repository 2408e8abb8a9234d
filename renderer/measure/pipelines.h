// What single precision costs by each way of computing a place in the map: positions from a place nearby or from the
// world's origin (map.origin), one matrix or the texture matrix from the eye (map.transform).
#pragma once

#include <vector>

#include "renderer/reference/precision.h"
#include "renderer/render/renderer.h"

namespace si {

struct PipelineError {
    MapOrigin origin;
    MapTransform transform;
    std::size_t pixels = 0;  ///< that are looked up
    PrecisionSpread texels, ulps;
    std::size_t flips = 0;  ///< pixels on the other side of one half than by the first of all
};

/// All four, from a place nearby by one matrix first. @throws Error where view.light has no map
std::vector<PipelineError> compare_pipelines(Renderer& renderer, const Scene& scene, const Settings& settings,
                                             int width, int height);

}  // namespace si
