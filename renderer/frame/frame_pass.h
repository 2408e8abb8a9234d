// Interface of a frame's passes. A pass owns its targets, declares its reads and writes, and draws.
#pragma once

namespace si {

struct FrameState;

/// One drawing pass of the frame, or a few passes that share targets. The targets are members: they outlast a frame and
/// keep their addresses, on which Pass::cached and Plan rely.
class FramePass {
public:
    FramePass() = default;
    FramePass(const FramePass&) = delete;
    FramePass& operator=(const FramePass&) = delete;
    virtual ~FramePass() = default;

    /// Adds the pass to `f.plan`: its reads, writes and key, the reason when the scene does not need the pass, and the
    /// place of its results. Draws nothing. `f` must stay at its address until the plan has run.
    virtual void declare(FrameState& f) = 0;
};

}  // namespace si
