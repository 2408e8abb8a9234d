// The shadow maps.
#pragma once

#include <array>
#include <vector>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"
#include "renderer/optimisations/static_casters.h"
#include "renderer/view/culling/map_cells.h"

namespace si {

class PagePasses;

/// What of a light is drawn apart from what moves.
struct StaticOfLight {
    StaticCasters casters;
    std::uint64_t geometry = 0;  ///< that was drawn last
    std::uint64_t views = 0;     ///< key of that map but for its casters
};

struct DrawnMaps {
    gl::Target maps, unfiltered;                   ///< a layer a view
    gl::Target static_casters;                     ///< the same of the casters that rest; none where nothing moves
    gl::Target depth;                              ///< beside a colour map, of one view
    std::array<std::uint64_t, kMaxLights> keys{};  ///< by light, of its layers' contents
    /// By light, what of each of its layers was drawn: of the rest nothing has been called for yet.
    std::array<std::vector<MapCells>, kMaxLights> held;
    std::array<StaticOfLight, kMaxLights> at_rest;
};

/// Draws the scene's depth as each light sees it, a pass a light.
class LightDepthPasses : public FramePass {
public:
    void declare(FrameState& f) override;
    DrawnMaps& maps() { return maps_; }

private:
    DrawnMaps maps_;
};

/// Draws the maps again where what is compared is not what a caster's surface is.
class UnfilteredMapPass : public FramePass {
public:
    UnfilteredMapPass(LightDepthPasses& light_depth, PagePasses& pages) : light_depth_(light_depth), pages_(pages) {}
    void declare(FrameState& f) override;

private:
    void run(FrameState& f, PassInfo& info);

    LightDepthPasses& light_depth_;
    PagePasses& pages_;
};

}  // namespace si
