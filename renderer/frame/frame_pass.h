// Interface of a frame's passes. A pass owns its targets, declares its reads and writes, and draws.
#pragma once

namespace si {

struct FrameState;

/// Interface of one drawing pass of a frame, or of a few passes that share targets. A pass owns its targets (textures
/// to draw into) as members. Targets outlast a frame and keep their addresses, as Pass::cached and Plan need.
class FramePass {
public:
    FramePass() = default;
    FramePass(const FramePass&) = delete;
    FramePass& operator=(const FramePass&) = delete;
    virtual ~FramePass() = default;

    /// Adds the pass to the frame's plan (`f.plan`): its reads, writes and key, the reason when the scene does not need
    /// the pass, and the place of its results. Draws nothing. `f` must stay at its address until the plan has run.
    virtual void declare(FrameState& f) = 0;
};

}  // namespace si
