// The map viewer: its state, facts and requests.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "renderer/frame/depth_histogram.h"
#include "renderer/frame/frame.h"
#include "renderer/inspect/texel_usage.h"
#include "ui/panels/health_panel.h"

namespace si {

/// Pan and zoom of the map viewer.
struct MapWindow {
    float zoom = 1;          ///< 1: the map fits
    glm::vec2 centre{0.5f};  ///< map coordinates in the middle of the viewer, v up
};

/// State of the map viewer: pan and zoom, marked texels, and the file that its Save button writes.
struct MapPanel {
    MapWindow window;
    bool exact_texels = false;                 ///< marks the texels that kernels fetch
    std::optional<MarkedTexel> marked_texel;   ///< outlined texel with an invalid number (panel Numbers)
    std::string save_path = "shadow-map.pfm";  ///< file that its Save button writes
    std::optional<glm::ivec2> hovered_texel;   ///< texel under the mouse, y up
};

/// Statistics of the depth image in the map viewer, for its plots.
struct MapPlots {
    DepthStatistics statistics;
    DepthHistogram histogram;  ///< histogram of the values that view.map shows
};

/// Data that the map viewer shows, copied from the GPU after a frame. A null pointer means that nothing was copied.
struct MapPanelFacts {
    const FloatImage* map_values = nullptr;  ///< the map viewer's depth image as stored, row 0 at the top
    const MapPlots* map_facts = nullptr;
    const FloatImage* map_coordinates = nullptr;  ///< FrameResult::map_coordinates read back
    const TexelUsage* texel_usage = nullptr;      ///< texels of the shown view that pixels read
    const TexelUsage* frozen_usage = nullptr;     ///< texels that the frozen camera's pixels read
    std::optional<double> exact_utilisation;      ///< share of texels that kernels fetch (FrameResult::texels_read)
};

/// Requests of the map viewer to the application: images to draw and numbers to copy from the GPU.
struct MapRequests {
    bool want_map = false;           ///< the map is shown
    bool want_map_values = false;    ///< the cursor is over the map
    bool want_map_facts = false;     ///< the plots are shown
    bool want_links = false;         ///< texel coordinates of pixels: the mouse is over a picture and drags nothing
    bool want_exact_texels = false;  ///< texels that kernels fetch: chosen, the map is shown, nothing is dragged
    bool want_frozen_usage = false;  ///< texels of the frozen camera: the map is shown, nothing is dragged
};

}  // namespace si
