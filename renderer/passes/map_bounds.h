// Pass that bounds the depths of shadow maps by two parallel planes for each block of texels.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Pass that finds for each block of map texels two parallel planes that enclose all depths within the kernel's reach.
/// A look-up whose receiver lies before or behind both planes fetches no taps (Optimisation::EarlyOut).
class MapBoundsPass : public FramePass {
public:
    /// Images that MapBoundsPass draws and keeps between frames. They hold for each block of map texels the slope of
    /// its two bounding planes, and the depths of both planes at the block's middle.
    struct Targets {
        gl::Target bounds;  ///< RGBA32F, a layer for each view
        gl::Target cells;   ///< bounds of single cells, before widening by the kernel's reach; one view
    };

    void declare(FrameState& f) override;

private:
    /// Computes for each block of map texels the two planes that enclose all depths within the kernel's reach, in all
    /// map layers. Called when a frame draws this pass.
    /// @param[out] info draw and triangle counts
    void run(const FrameState& f, PassInfo& info);

    Targets targets_;
};

}  // namespace si
