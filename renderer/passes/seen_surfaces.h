// Pass that stores the surface visible at each pixel.
#pragma once

#include <array>
#include <span>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Draws position and normals of every pixel's surface. The images are kept while camera and scene stay, for passes
/// that evaluate pixels again.
class VisibleSurfacesPass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    /// Draws the surface images. Called when the plan runs the pass.
    /// @param count number of images to draw
    /// @param[out] info draw counts
    void run(FrameState& f, std::size_t count, PassInfo& info);

    std::array<gl::Target, kVisibleSurfaceImages> images_;  ///< RGBA32F; the key of all is the first one's
};

/// Binds another set of surface images in place of the frame's, for evaluating other pixels with the same shaders.
void bind_visible_surfaces(std::span<const gl::Target, kVisibleSurfaceImages> seen);

}  // namespace si
