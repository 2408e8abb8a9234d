// What the camera draws of the scene, and in what order (Optimisation::FrustumCulling, Optimisation::DepthOrder). Kept
// until camera or objects change.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/view/culling/draw_order.h"

namespace si {

struct FrameState;

class SeenObjects {
public:
    /// Arranges what the frame's camera draws: see SceneGpu::set_camera_instances().
    void arrange(const FrameState& f);
    /// Objects that no pixel of the frame can show, and that are not drawn.
    std::size_t left_out() const { return left_out_; }

private:
    std::uint64_t of_ = 0;        ///< key of the arrangement whose boxes these are
    std::uint64_t of_seen_ = 0;   ///< and of the camera
    std::vector<SkewBox> boxes_;  ///< by instance
    std::optional<std::vector<BoxPair>> touching_;
    std::size_t left_out_ = 0;

    void learn_boxes(const FrameState& f);
};

}  // namespace si
