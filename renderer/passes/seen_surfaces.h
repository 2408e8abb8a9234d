// The surfaces that the camera sees, kept as images.
#pragma once

#include <array>
#include <span>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Draws the surface of every pixel, kept while camera and scene stay, for passes that evaluate some of them again.
class VisibleSurfacesPass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    void run(FrameState& f, std::size_t count, PassInfo& info);

    std::array<gl::Target, kVisibleSurfaceImages> images_;  ///< RGBA32F; the key of all is the first one's
};

/// Binds images of other pixels in place of the frame's.
void bind_visible_surfaces(std::span<const gl::Target, kVisibleSurfaceImages> seen);

}  // namespace si
