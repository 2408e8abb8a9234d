// The map viewer: its state, facts and requests.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "renderer/frame/frame.h"
#include "renderer/inspect/depth_histogram.h"
#include "renderer/inspect/texel_usage.h"
#include "ui/panels/health_panel.h"

namespace si {

/// Pan and zoom of the map viewer: `zoom` 1 fits the map; `centre` is what stands in the middle, v up.
struct MapWindow {
    float zoom = 1;
    glm::vec2 centre{0.5f};
};

/// State of the map viewer.
struct MapPanel {
    MapWindow window;
    bool exact_texels = false;                 ///< marks the texels that kernels fetch
    std::optional<MarkedTexel> marked_texel;   ///< texel of a finding of the panel Numbers, outlined
    std::string save_path = "shadow-map.pfm";  ///< file that its Save button writes
    std::optional<glm::ivec2> hovered_texel;   ///< texel under the mouse, y up
};

/// Statistics of the depth image in the map viewer.
struct MapPlots {
    DepthStatistics statistics;
    DepthHistogram histogram;  ///< of the values that view.map shows
};

struct MapPanelFacts {
    const FloatImage* map_values = nullptr;  ///< the map viewer's depth image as stored, row 0 at the top
    const MapPlots* map_facts = nullptr;
    const FloatImage* map_coordinates = nullptr;  ///< FrameResult::map_coordinates read back
    const TexelUsage* texel_usage = nullptr;      ///< of the shown light and face
    const TexelUsage* frozen_usage = nullptr;     ///< the same by the pixels of state.frozen
    std::optional<double> exact_utilisation;      ///< share of the texels that kernels fetch: FrameResult::texels_read
};

struct MapRequests {
    std::optional<std::string> save_map;
    bool want_map = false;
    bool want_map_values = false;    ///< the cursor is over the map
    bool want_map_facts = false;     ///< the plots are shown
    bool want_links = false;         ///< which pixel reads which texel: a picture is hovered and nothing is dragged
    bool want_exact_texels = false;  ///< which texels kernels fetch: asked for, the map is shown, nothing is dragged
    bool want_frozen_usage = false;  ///< what the frozen camera reads: the map is shown and nothing is dragged
};

}  // namespace si
