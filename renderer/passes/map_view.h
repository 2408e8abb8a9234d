// Passes that draw the map viewer's picture.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Passes that draw the map viewer's picture of a shadow map or of the camera's depth. There are three: the shown
/// channel of a map of depth moments (Result::MapChannel), the drawn depth range (Result::DepthRange) and the picture
/// (Result::MapView).
class MapViewPasses : public FramePass {
public:
    /// Images that MapViewPasses draws and keeps between frames for the map viewer, and the range of the depths in the
    /// shown map.
    struct Targets {
        gl::Target picture, range, channel;
        glm::vec2 drawn{0, 1};  ///< smallest and largest drawn depth
    };

    void declare(FrameState& f) override;
    /// Returns the depths that the map viewer shows black (x) and white (y), on the scale of shown_depth(). They are
    /// fitted to the drawn depths (view.map_fit, view.map_contrast), or equal view.map_black and view.map_white.
    glm::vec2 grey_range(const FrameState& f) const;

private:
    /// Draws the map viewer's picture. Called when a frame draws this pass.
    /// @param camera true: shows the camera's depth in place of a shadow map
    /// @param layer layer of the shadow map textures to show
    /// @param[out] info draw and triangle counts
    void run(FrameState& f, bool camera, int layer, PassInfo& info);

    Targets targets_;
};

}  // namespace si
