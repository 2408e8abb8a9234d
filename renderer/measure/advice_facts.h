// What of a scene, its frame and its truth says which settings are worth trying.
#pragma once

#include "renderer/measure/cures.h"

namespace si {

/// About view.light, over the pixels that count for it unless another is named. Numbers of what there is none are NaN.
struct AdviceFacts {
    ErrorMetrics error;
    BiasNeeds needs;  ///< no pixels where the light has no map
    std::vector<FittedLight> lights;
    int light = 0, map_resolution = 0;
    std::size_t pixels = 0;                ///< that count
    double nearest_m = 0, farthest_m = 0;  ///< along the camera's axis
    double texel_px = 0;                   ///< width of the map's texels in pixels of the picture, median
    double penumbra_texels = 0;      ///< widest that the light throws in the picture, in texels; 99 of 100 are narrower
    double read_share = 1;           ///< of the texels of a light's only map, that some kernel fetches
    std::uint64_t paged_texels = 0;  ///< of virtual maps, that are read; 0: maps are whole
    std::vector<double> shadowed;    ///< by light: share of the pixels that count for it, which are in its shadow
    std::vector<std::string> notes;  ///< of the frame
    const FittedLight* fitted() const {
        return std::size_t(light) < lights.size() ? &lights[std::size_t(light)] : nullptr;
    }
};

/// Draws and traces. On the renderer's thread. @throws Cancelled, Error
AdviceFacts advice_facts(Renderer& renderer, const Scene& scene, const Settings& measured, int width, int height,
                         ReferenceCache& cache, const Workers& workers);

}  // namespace si
