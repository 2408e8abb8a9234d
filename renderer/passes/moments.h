// Pass that filters functions of shadow map depths, for VSM, ESM, MSM and the like.
#pragma once

#include <vector>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Returns the results that a pass reads when it evaluates the filter kernel, for Pass::reads.
std::vector<ResultRef> kernel_inputs(const FrameState& f);

/// Computes functions of the maps' depths, averaged around each texel. Kernels with pre-filtered maps (VSM, ESM, MSM)
/// read these moments in place of depths.
class MomentsPass : public FramePass {
public:
    /// Images that MomentsPass draws and keeps between frames: the moments of moment kernels (VSM, ESM, EVSM, MSM), and
    /// intermediate steps.
    struct Targets {
        gl::Target moments;   ///< a layer for each view
        gl::Target steps[2];  ///< intermediate layer between two draws
        gl::Target samples;   ///< multisampled depth of one view
    };

    void declare(FrameState& f) override;

private:
    /// Computes the moments of all map layers. Called when the plan runs the pass.
    /// @param[out] info draw counts
    void run(FrameState& f, PassInfo& info);

    Targets targets_;
};

}  // namespace si
