// Pass that measures the errors of single precision, pixel by pixel.
#pragma once

#include <memory>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

struct Precision;

/// Pass that measures rounding errors of shadow map look-ups for view.light. Compares the map coordinates that the GPU
/// computes in single precision with double precision on the CPU.
class PrecisionPass : public FramePass {
public:
    void declare(FrameState& f) override;
    /// Returns the rounding errors of map look-ups that the last run measured; null before the first run.
    const std::shared_ptr<const Precision>& found() const { return found_; }

private:
    /// Draws the map coordinates of all pixels' look-ups, reads them back and compares them with double precision on
    /// the CPU. Called when a frame draws this pass.
    /// @param[out] info draw and triangle counts
    void run(FrameState& f, PassInfo& info);

    gl::Target uvd_;    ///< RGBA32F, see DrawnLookUps
    gl::Target error_;  ///< RG32F: error in texels and in depth steps; -1: none
    std::shared_ptr<const Precision> found_;
};

}  // namespace si
