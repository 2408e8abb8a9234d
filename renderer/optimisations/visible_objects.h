// Visible objects of a picture and their draw order (Optimisation::FrustumCulling, Optimisation::DepthOrder), cached
// until camera or objects change.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/view/culling/draw_order.h"

namespace si {

struct FrameState;

/// Draw order of the objects in the picture: culls objects by the camera's frustum and sorts the visible ones front to
/// back.
class VisibleObjects {
public:
    /// Culls the objects outside the camera's view frustum, sorts the others front to back, and passes the draw order
    /// to the scene on the GPU (SceneGpu::set_camera_instances()). Does nothing while camera and objects are unchanged.
    void arrange(const FrameState& f);
    /// Returns the number of objects outside the view frustum, which are not drawn.
    std::size_t skipped_count() const { return skipped_; }

private:
    std::uint64_t of_ = 0;                          ///< cache key of the instances in `boxes_`
    std::uint64_t of_seen_ = 0;                     ///< cache key of instances and camera
    std::vector<SkewBox> boxes_;                    ///< by instance
    std::optional<std::vector<BoxPair>> touching_;  ///< touching_boxes() of `boxes_`
    std::size_t skipped_ = 0;

    /// Computes the world-space boxes of all objects, for culling, if the scene has changed.
    void update_boxes(const FrameState& f);
};

}  // namespace si
