// Passes of a frame as objects: each holds what it draws into, says what it reads and writes, and draws.
#pragma once

namespace si {

struct FrameState;

/// One pass, or a few that share targets. Targets are members: they outlast a frame and keep their addresses, on which
/// Pass::cached and Plan rely.
class FramePass {
public:
    FramePass() = default;
    FramePass(const FramePass&) = delete;
    FramePass& operator=(const FramePass&) = delete;
    virtual ~FramePass() = default;

    /// Adds the passes to `f.plan`: what each reads, writes and depends on, why it is not needed, and where its results
    /// lie. Draws nothing. `f` stays where it is until the plan is carried out.
    virtual void declare(FrameState& f) = 0;
};

}  // namespace si
