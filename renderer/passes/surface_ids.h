// Pass that stores object and triangle of each pixel.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Draws the object and triangle number that each pixel shows, see SurfaceIds.
class SurfaceIdsPass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    /// Draws object and triangle numbers of all pixels. Called when the plan runs the pass.
    /// @param[out] info draw counts
    void run(FrameState& f, PassInfo& info);

    gl::Target ids_;  ///< RG32UI
};

}  // namespace si
