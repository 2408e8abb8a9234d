// Pass that marks the map texels which the picture reads.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Marks exactly the texels of the shown map that the kernels of all pixels fetch.
class TexelsReadPass : public FramePass {
public:
    /// Images that TexelsReadPass draws and keeps between frames: marks of the map texels that the picture reads.
    struct Targets {
        gl::Target marks;    ///< R32F, the map's resolution: 1 where a kernel fetches the texel
        gl::Target nothing;  ///< unused image of the picture's size, as OpenGL needs an attachment
    };

    void declare(FrameState& f) override;

private:
    /// Evaluates all pixels' kernels and marks each fetched texel. Called when the plan runs the pass.
    /// @param layer layer of the shadow maps
    void run(const FrameState& f, int layer, PassInfo& info);

    Targets targets_;
};

}  // namespace si
