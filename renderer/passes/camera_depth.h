// Pass that draws the camera's depth alone.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Draws the depth of visible surfaces (Resources::camera_depth) for passes that read it. Does nothing where another
/// pass from the camera (CameraPass) has already drawn the depth.
class CameraDepthPass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    /// Draws the depth of visible surfaces for the camera. Called when the plan runs the pass.
    /// @param[out] info draw counts
    static void run(FrameState& f, PassInfo& info);
};

}  // namespace si
