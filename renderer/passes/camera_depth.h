// The camera's depth as a pass of its own.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Draws the depth that the camera sees (Resources::camera_depth) for passes that read it. Where any pass from the
/// camera (CameraPass) has run before, it is there already.
class CameraDepthPass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    static void run(FrameState& f, PassInfo& info);
};

}  // namespace si
