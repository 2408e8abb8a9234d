#include "renderer/optimisations/visible_objects.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/frame/state.h"
#include "renderer/view/culling/box_culling.h"

namespace si {
namespace {

/// Of the scene's size: what floats make of a vertex and of its depth.
constexpr double kRoomShare = 1e-5;

}  // namespace

void SeenObjects::learn_boxes(const FrameState& f) {
    const SceneGpu& gpu = *f.gl.scene;
    if (of_ == gpu.key().value()) return;
    of_ = gpu.key().value();
    of_seen_ = 0;
    boxes_.clear();
    Bounds all;
    for (const std::uint32_t number : gpu.instance_objects()) {
        const Object& o = f.scene.objects[number];
        const Bounds& local = f.scene.meshes[std::size_t(o.mesh)].bounds;
        boxes_.emplace_back(local, o.world);
        all.add(local.transformed(o.world));
    }
    touching_ = touching_boxes(boxes_, kRoomShare * all.radius());
}

void SeenObjects::arrange(const FrameState& f) {
    SceneGpu& gpu = *f.gl.scene;
    learn_boxes(f);
    const bool all = f.request.forced.contains(Optimisation::FrustumCulling);
    // Depths that crowd at the far plane would put into one place what lies far apart.
    const bool sorts =
        touching_ && f.camera.curve.convention.reversed && !f.request.forced.contains(Optimisation::DepthOrder);
    const std::uint64_t key = Key(gpu.key()).add(f.camera_key.value()).add(all).add(sorts).value();
    if (of_seen_ == key) return;
    of_seen_ = key;
    left_out_ = 0;
    const BoxSight sight(f.camera.clip_from_relative(f.origin), f.origin, f.camera.curve.convention, false,
                         std::min(f.request.width, f.request.height));
    const glm::dvec3 forward = -f.camera.axes[2];
    std::vector<DrawnBox> drawn(boxes_.size());
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
        const Batch& batch = gpu.batches()[gpu.instance_batches()[i]];
        drawn[i].seen = all || !sight.misses(boxes_[i]);
        left_out_ += !drawn[i].seen;
        drawn[i].group = batch.blend ? 2 : batch.masked ? 1 : 0;
        if (batch.blend) continue;  // whoever draws them sorts them
        double far_m = glm::dot(boxes_[i].centre - f.camera.eye, forward);
        for (int axis = 0; axis < 3; ++axis) far_m += std::abs(glm::dot(boxes_[i].half[axis], forward));
        drawn[i].far_m = std::isfinite(far_m) ? far_m : std::numeric_limits<double>::max();
    }
    if (sorts) {
        gpu.set_camera_instances(nearest_first(drawn, *touching_));
        return;
    }
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < drawn.size(); ++i)
        if (drawn[i].seen) order.push_back(i);
    gpu.set_camera_instances(order);
}

}  // namespace si
