// Errors of single precision, pixel by pixel.
#pragma once

#include <memory>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

struct Precision;

/// Compares where the shown light's map is looked up with the same in double precision on the CPU.
class PrecisionPass : public FramePass {
public:
    void declare(FrameState& f) override;
    /// Returns what the last run found; null before the first.
    const std::shared_ptr<const Precision>& found() const { return found_; }

private:
    void run(FrameState& f, PassInfo& info);

    gl::Target uvd_;    ///< RGBA32F, see DrawnLookUps
    gl::Target error_;  ///< RG32F: texels or -1, steps of depth or -1
    std::shared_ptr<const Precision> found_;
};

}  // namespace si
