// Averages of functions of the maps' depths.
#pragma once

#include <vector>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Returns what a pass reads that evaluates the kernel.
std::vector<ResultRef> kernel_inputs(const FrameState& f);

/// Makes functions of the maps' depths, averaged about each texel, for kernels that read those in place of depths.
class MomentsPass : public FramePass {
public:
    struct Targets {
        gl::Target moments;   ///< a layer a view
        gl::Target steps[2];  ///< one layer between two draws
        gl::Target samples;   ///< one view's map with several samples a texel
    };

    void declare(FrameState& f) override;

private:
    void run(FrameState& f, PassInfo& info);

    Targets targets_;
};

}  // namespace si
