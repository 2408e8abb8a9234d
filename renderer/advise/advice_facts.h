// Measurements of a scene, its frame and its reference, from which advice rules propose setting changes.
#pragma once

#include "renderer/advise/fixes.h"

namespace si {

/// Measurements of a frame on which advice rules decide which setting changes to propose. They concern the light
/// view.light and its counted pixels (PixelState::Counted), unless stated otherwise. Unknown numbers are NaN.
struct AdviceFacts {
    ErrorMetrics error;
    std::vector<BiasStart> starts;  ///< rows of the bias table; empty when no pixel needs bias
    std::vector<FittedLight> lights;
    int light = 0;                         ///< view.light
    int map_resolution = 0;                ///< texels of a map's longer side
    MapSize map_size;                      ///< texels of a map
    std::size_t pixels = 0;                ///< number of counted pixels
    double nearest_m = 0, farthest_m = 0;  ///< range of depths along the camera's axis
    double texel_px = 0;                   ///< median width of the map's texels, in pixels of the picture
    double penumbra_texels = 0;            ///< penumbra width, 99th percentile, in texels
    double read_share = 1;                 ///< share of texels that kernels fetch, for lights with a single map
    std::uint64_t paged_texels = 0;        ///< texels of virtual maps that are read; 0: maps are whole
    std::vector<double> shadowed;          ///< share of each light's counted pixels in shadow
    std::vector<std::string> notes;        ///< warnings of the renderer (FrameResult::notes)
    /// Returns the frame's data of view.light; null: there is no such light.
    const FittedLight* fitted() const {
        return std::size_t(light) < lights.size() ? &lights[std::size_t(light)] : nullptr;
    }
};

/// Measures a scene for the advice rules: draws a frame, traces its reference and classifies the pixels.
/// @param measured settings of the frame, as returned by measured_settings()
/// @throws Cancelled, Error
AdviceFacts advice_facts(const SearchTools& tools, const Settings& measured);

}  // namespace si
