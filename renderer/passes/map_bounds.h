// Pass that finds nearest and farthest depths of shadow maps, by block.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Finds the nearest and farthest depth within the kernel's reach of each block of map texels. Look-ups whose receiver
/// lies on one side of both fetch no taps (Optimisation::EarlyOut).
class MapBoundsPass : public FramePass {
public:
    /// Images that MapBoundsPass draws and keeps between frames: smallest and largest depths of blocks of map texels.
    struct Targets {
        gl::Target bounds;  ///< RGBA32F, a layer for each view
        gl::Target cells;   ///< bounds of single cells, before widening by the kernel's reach; one view
    };

    void declare(FrameState& f) override;

private:
    /// Computes the smallest and largest depth within the kernel's reach of each block of texels, in all map layers.
    /// Called when the plan runs the pass.
    /// @param[out] info draw counts
    void run(const FrameState& f, PassInfo& info);

    Targets targets_;
};

}  // namespace si
