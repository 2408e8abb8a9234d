// Texels of the shown map that the picture reads.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Marks exactly which texels of the shown map the kernels of all pixels fetch.
class TexelsReadPass : public FramePass {
public:
    struct Targets {
        gl::Target marks;    ///< R32F, a texel of the map each
        gl::Target nothing;  ///< a pixel for each of the picture; OpenGL wants something to draw into
    };

    void declare(FrameState& f) override;

private:
    void run(const FrameState& f, int layer, PassInfo& info);

    Targets targets_;
};

}  // namespace si
