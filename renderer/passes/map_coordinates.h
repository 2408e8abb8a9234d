// Places of the picture's look-ups in the shown map.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Draws where in the shown light's map each pixel's kernel is centred.
class MapCoordinatesPass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    void run(FrameState& f, PassInfo& info);

    gl::Target coordinates_;  ///< RGBA32F
};

}  // namespace si
