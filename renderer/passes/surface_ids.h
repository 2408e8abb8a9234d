// Triangle and object of each pixel.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Draws which triangle of which object each pixel shows.
class SurfaceIdsPass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    void run(FrameState& f, PassInfo& info);

    gl::Target ids_;  ///< RG32UI
};

}  // namespace si
