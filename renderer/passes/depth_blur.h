// Blurred depths: the wrong way to soften a shadow map.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Averages the depths of the shadow maps themselves (map.blur_texels).
class DepthBlurPass : public FramePass {
public:
    struct Targets {
        gl::Target maps, rows;  ///< as the maps are laid out, and one layer along x only
    };

    void declare(FrameState& f) override;

private:
    void run(FrameState& f, int radius, PassInfo& info);

    Targets targets_;
};

}  // namespace si
