// Pass that draws blob shadows.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Pass that draws blob shadows: a soft disc below each caster, for lights whose source is blobs (light.source).
class BlobPass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    gl::Target lit_;  ///< R16F, a layer for each light: visibility 1 to 0
};

}  // namespace si
