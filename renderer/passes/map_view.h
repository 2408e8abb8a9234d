// The map viewer's picture.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Draws a depth image as a picture for people, a shadow map or the camera's depth: the moment shown
/// (Result::MapChannel), the range of what was drawn (Result::DepthRange) and the picture (Result::MapView).
class MapViewPasses : public FramePass {
public:
    struct Targets {
        gl::Target picture, range, channel;
        glm::vec2 drawn{0, 1};  ///< smallest and largest drawn depth, as `range` has them
    };

    void declare(FrameState& f) override;
    /// Returns which values are black and white, as shares of the range: fitted to what was drawn (view.map_fit), else
    /// view.map_black and view.map_white.
    glm::vec2 grey_range(const FrameState& f) const;

private:
    void run(FrameState& f, bool camera, int layer, PassInfo& info);

    Targets targets_;
};

}  // namespace si
