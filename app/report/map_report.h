// Depth statistics and utilisation of the shown light's map, for reports.
#pragma once

#include <optional>
#include <vector>

#include "app/base/json_text.h"
#include "renderer/frame/depth_histogram.h"
#include "renderer/inspect/texel_usage.h"
#include "renderer/render/renderer.h"

namespace si {

/// Statistics of one light's shadow map: the share of texels that the picture reads, and the depths that the map holds.
struct MapReport {
    int light = 0, face = 0;
    MapSize size;
    TexelUsage usage;                  ///< texels of the shown face that the picture reads
    std::vector<double> utilisations;  ///< share of texels read, per face
    double exact_utilisation = 0;  ///< share of texels of the shown face that the kernel fetches; not bounding boxes
    DepthStatistics depth;
    DepthHistogram raw, linear;  ///< over the range of depths that was drawn
};

/// Draws a frame and collects statistics of the shadow map of the light that view.light selects; nullopt if that light
/// has no map. @param request gives the size of the picture
std::optional<MapReport> map_report(Renderer& renderer, const Scene& scene, Settings settings, FrameRequest request);

/// Converts the statistics of one light's shadow map to JSON.
nlohmann::ordered_json map_report_json(const MapReport& facts);

}  // namespace si
