// Precision of map look-ups in single precision for each pipeline: positions relative to a nearby origin or to the
// world's origin (map.origin), one matrix or the texture matrix from eye space (map.transform).
#pragma once

#include <vector>

#include "renderer/reference/precision.h"
#include "renderer/render/renderer.h"

namespace si {

/// Rounding error of shadow-map look-ups by one pipeline, a combination of map.origin and map.transform.
struct PipelineError {
    MapOrigin origin;
    MapTransform transform;
    std::size_t pixels = 0;        ///< number of pixels with a look-up
    PrecisionSpread texels, ulps;  ///< rounding error in texels, and in ULPs of the depth (Precision)
    std::size_t flips = 0;         ///< number of pixels lit here but in shadow by the first pipeline, or the reverse
};

/// Measures the rounding errors of shadow-map look-ups in one picture by all four pipelines, the combinations of
/// map.origin and map.transform. The first is the most precise: nearby origin, one matrix.
/// @param width, height of the picture in pixels @throws Error when view.light has no map
std::vector<PipelineError> compare_pipelines(Renderer& renderer, const Scene& scene, const Settings& settings,
                                             int width, int height);

}  // namespace si
