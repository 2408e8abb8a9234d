// The lit picture.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Draws the lit picture, which evaluates visibility itself unless the visibility texture exists anyway. For a view
/// that does not move, also the mean of several pictures (Result::Smooth).
class ShadePasses : public FramePass {
public:
    /// What the mean is made of.
    struct SmoothTargets {
        gl::Target one, depth;  ///< of one picture
        gl::Target sum, mean;
        std::uint64_t of = 0;  ///< key of what is summed up
        int count = 0;
    };

    void declare(FrameState& f) override;

private:
    void run(FrameState& f, PassInfo& info);
    /// @param of key of the picture that is made smooth
    void declare_smooth(FrameState& f, std::uint64_t of);

    gl::Target picture_;
    SmoothTargets smooth_;
};

/// Draws the picture once more with the visibility that rays found for the shown light.
class ReferenceShadePass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    void run(FrameState& f, PassInfo& info);

    gl::Target picture_;
    gl::Target visibility_;  ///< as Result::Visibility
};

}  // namespace si
