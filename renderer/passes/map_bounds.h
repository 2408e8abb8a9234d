// Pass that bounds the depths of shadow maps by two parallel planes for each block of texels.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Finds for each block of map texels two parallel planes, between which all depths within the kernel's reach lie. A
/// look-up whose receiver lies before or behind both planes fetches no taps (Optimisation::EarlyOut).
class MapBoundsPass : public FramePass {
public:
    /// Images that MapBoundsPass draws and keeps between frames: for each block of map texels the slope of the planes,
    /// and the smallest and largest depth minus slope.
    struct Targets {
        gl::Target bounds;  ///< RGBA32F, a layer for each view
        gl::Target cells;   ///< bounds of single cells, before widening by the kernel's reach; one view
    };

    void declare(FrameState& f) override;

private:
    /// Computes the bounding planes of the depths within the kernel's reach of each block of texels, in all map layers.
    /// Called when the plan runs the pass.
    /// @param[out] info draw counts
    void run(const FrameState& f, PassInfo& info);

    Targets targets_;
};

}  // namespace si
