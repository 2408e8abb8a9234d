// Pass that blurs stored depths: the wrong way to soften a shadow map.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Pass that blurs the stored depths of the shadow maps (map.blur_texels), to demonstrate why averaged depths give
/// wrong shadows.
class DepthBlurPass : public FramePass {
public:
    /// Images that DepthBlurPass draws and keeps between frames: the blurred depths, and depths blurred along x alone.
    struct Targets {
        gl::Target maps, rows;  ///< blurred maps, a layer for each view; one layer blurred along x
    };

    void declare(FrameState& f) override;

private:
    /// Blurs the depths in all layers of the shadow maps by a box filter. Called when a frame draws this pass.
    /// @param radius texels on each side of a texel
    /// @param[out] info draw and triangle counts
    void run(FrameState& f, int radius, PassInfo& info);

    Targets targets_;
};

}  // namespace si
