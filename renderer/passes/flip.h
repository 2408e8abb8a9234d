// Pass that measures the perceived difference between the picture and the picture with the reference's shadows.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Pass that measures how different the picture looks from the picture with the reference's shadows. Reads back both
/// pictures, computes LDR-FLIP on the CPU (flip_difference()) and uploads the result for an overlay.
class FlipPass : public FramePass {
public:
    void declare(FrameState& f) override;
    /// Returns the mean difference (FLIP, 0 to 1) between the picture and that with the reference's shadows in the last
    /// run; 0 before the first run.
    double mean() const { return mean_; }

private:
    gl::Target map_;  ///< R32F, rows from the bottom
    double mean_ = 0;
};

}  // namespace si
