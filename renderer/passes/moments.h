// Pass that filters functions of shadow map depths, for VSM, ESM, MSM and the like.
#pragma once

#include <vector>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Returns the images that a pass reads when it evaluates the filter kernel: the shadow maps, and moments (averaged
/// functions of depth) or depth bounds. Used to fill in Pass::reads.
std::vector<ResultRef> kernel_inputs(const FrameState& f);

/// Pass that computes moments of the shadow maps: functions of depth, averaged around each texel. Filter kernels with
/// pre-filtered maps (VSM, ESM, MSM) read the moments in place of depths.
class MomentsPass : public FramePass {
public:
    /// Images that MomentsPass draws and keeps between frames: the moments (averaged functions of depth) of kernels
    /// such as VSM, ESM, EVSM and MSM, and intermediate steps.
    struct Targets {
        gl::Target moments;   ///< a layer for each view
        gl::Target steps[2];  ///< intermediate layer between two draws
        gl::Target samples;   ///< multisampled depth of one view
    };

    void declare(FrameState& f) override;

private:
    /// Computes the moments (averaged functions of depth) of all shadow map layers. Called when a frame draws this
    /// pass.
    /// @param[out] info draw and triangle counts
    void run(FrameState& f, PassInfo& info);

    Targets targets_;
};

}  // namespace si
