// Passes that draw the shaded picture.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Passes that draw the shaded picture. Visibility is evaluated in the same shader unless a separate visibility image
/// exists. While the view is static, they also accumulate the mean of pictures by a jittered camera (Result::Smooth).
class ShadePasses : public FramePass {
public:
    /// Images that ShadePasses draws and keeps between frames for view.smooth: the accumulated mean of jittered
    /// pictures.
    struct SmoothTargets {
        gl::Target one, depth;  ///< picture and depth of one jittered shading
        gl::Target sum, mean;
        std::uint64_t of = 0;  ///< cache key of the pictures in the sum
        int count = 0;
    };

    void declare(FrameState& f) override;

private:
    /// Adds to the frame's plan the pass that darkens creases of the picture (screen-space ambient obscurance), for the
    /// look "studio" (Result::Creases).
    void declare_creases(FrameState& f);
    /// Adds to the frame's plan the pass that averages pictures by a jittered camera, which smooths edges of a static
    /// view (Result::Smooth).
    /// @param of cache key of the picture to average; another key starts the mean again
    void declare_smooth(FrameState& f, std::uint64_t of);

    gl::Target picture_, creases_, crease_shares_;
    SmoothTargets smooth_;
};

/// Pass that draws the picture with the ray-traced visibility of view.light in place of the visibility by that light's
/// shadow map.
class ReferenceShadePass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    /// Uploads the ray-traced visibility of view.light and shades the picture with it. Called when a frame draws this
    /// pass.
    /// @param[out] info draw and triangle counts
    void run(FrameState& f, PassInfo& info);

    gl::Target picture_;
    gl::Target visibility_;  ///< copy of Result::Visibility with one layer replaced
};

}  // namespace si
