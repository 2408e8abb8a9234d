// Passes that draw the shadow maps.
#pragma once

#include <array>
#include <vector>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"
#include "renderer/optimisations/static_casters.h"
#include "renderer/view/culling/map_cells.h"

namespace si {

class PagePasses;

/// State of the cached map of one light's static casters, which stand still while others move: the casters, and the
/// cache keys of the map's contents.
struct StaticMapState {
    StaticCasters casters;
    std::uint64_t geometry = 0;  ///< cache key of the geometry drawn last
    std::uint64_t views = 0;     ///< cache key of the light's views, without its casters
};

/// Shadow map textures of all lights, with the keys of their contents.
struct DrawnMaps {
    gl::Target maps, unfiltered;                   ///< a layer for each view
    gl::Target static_casters;                     ///< maps of static casters alone; empty where nothing moves
    gl::Target depth;                              ///< depth buffer for one view of a colour map
    std::array<std::uint64_t, kMaxLights> keys{};  ///< by light: key of its layers' contents
    /// Cells of the maps (MapCells) drawn so far, by light and view. No look-up has needed the other cells yet.
    std::array<std::vector<MapCells>, kMaxLights> drawn_cells;
    std::array<StaticMapState, kMaxLights> static_states;
};

/// Passes that draw the shadow maps: the scene's depth from each light, one pass for each light.
class LightDepthPasses : public FramePass {
public:
    void declare(FrameState& f) override;
    /// Returns the shadow map textures of all lights, with the keys of their contents.
    DrawnMaps& maps() { return maps_; }

private:
    DrawnMaps maps_;
};

/// Pass that draws the shadow maps without polygon offset and with alpha masks at their finest mip level. The trials
/// that find the cause of a wrong pixel read these maps for the true depth of casters.
class UnfilteredMapPass : public FramePass {
public:
    UnfilteredMapPass(LightDepthPasses& light_depth, PagePasses& pages) : light_depth_(light_depth), pages_(pages) {}
    void declare(FrameState& f) override;

private:
    /// Draws a second shadow map of each light, without polygon offset and with alpha masks at their finest mip level.
    /// The trials that find the cause of a wrong pixel read it for the true depth of casters. Called when a frame draws
    /// this pass.
    /// @param[out] info draw and triangle counts
    void run(FrameState& f, PassInfo& info);

    LightDepthPasses& light_depth_;
    PagePasses& pages_;
};

}  // namespace si
