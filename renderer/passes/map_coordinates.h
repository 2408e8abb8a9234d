// Pass that finds where each pixel looks up the shown shadow map.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Draws for each pixel the map coordinates of the kernel's centre, in the map of view.light.
class MapCoordinatesPass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    /// Draws the map coordinates of all pixels. Called when the plan runs the pass.
    /// @param[out] info draw counts
    void run(FrameState& f, PassInfo& info);

    gl::Target coordinates_;  ///< RGBA32F
};

}  // namespace si
