// Bounds of the shadow maps' depths, by block.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Finds between which planes the maps' depths lie within the kernel's reach of each block. Look-ups that find both on
/// one side of their receiver fetch no taps (Optimisation::EarlyOut).
class MapBoundsPass : public FramePass {
public:
    struct Targets {
        gl::Target bounds;  ///< RGBA32F, a layer a view
        gl::Target cells;   ///< of one view, of cells alone
    };

    void declare(FrameState& f) override;

private:
    void run(const FrameState& f, PassInfo& info);

    Targets targets_;
};

}  // namespace si
