// Pass that marks the map texels which the picture reads.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Pass that marks exactly the texels of the shown shadow map that the filter kernels of all pixels fetch.
class TexelsReadPass : public FramePass {
public:
    /// Images that TexelsReadPass draws and keeps between frames: marks of the shadow map texels that the picture
    /// reads.
    struct Targets {
        gl::Target marks;    ///< R32F, the map's resolution: 1 where a kernel fetches the texel
        gl::Target nothing;  ///< unused image of the picture's size, as OpenGL needs an attachment
    };

    void declare(FrameState& f) override;

private:
    /// Evaluates the filter kernels of all pixels and marks each shadow map texel that they fetch. Called when a frame
    /// draws this pass.
    /// @param layer layer of the shadow map textures
    /// @param[out] info draw and triangle counts
    void run(const FrameState& f, int layer, PassInfo& info);

    Targets targets_;
};

}  // namespace si
