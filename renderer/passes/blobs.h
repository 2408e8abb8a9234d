// Blob shadows.
#pragma once

#include <vector>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Draws a soft disc below each caster, for lights whose source is blobs.
class BlobPass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    void run(const FrameState& f, const std::vector<int>& lights, PassInfo& info);

    gl::Target lit_;  ///< R16F, a layer a light: what the blobs leave of it
};

}  // namespace si
