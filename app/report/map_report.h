// What the shown light's map holds, and how much of it the picture reads, for reports.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "renderer/frame/depth_histogram.h"
#include "renderer/inspect/texel_usage.h"
#include "renderer/render/renderer.h"

namespace si {

struct MapReport {
    int light = 0, face = 0, resolution = 0;
    TexelUsage usage;                  ///< of the shown face
    std::vector<double> utilisations;  ///< of each face
    double exact_utilisation = 0;  ///< of the shown face: texels that a kernel fetches, not the rectangles about them
    DepthStatistics depth;
    DepthHistogram raw, linear;  ///< over the range that was drawn
};

/// Draws what it takes; `request` gives the size of the picture. Nothing when the light of view.light has no map.
std::optional<MapReport> map_report(Renderer& renderer, const Scene& scene, Settings settings, FrameRequest request);

nlohmann::ordered_json map_report_json(const MapReport& facts);

}  // namespace si
