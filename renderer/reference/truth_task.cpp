#include "renderer/reference/truth_task.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace si {
namespace {

/// The near plane of a view, where it stands and nothing else: the map's size and resolution are no part of the truth.
void add_near_plane(Key& key, const LightView& view) {
    key.add(view.axes[2]).add(view.curve.perspective);
    if (view.curve.perspective)
        key.add(view.eye).add(view.curve.near);
    else
        key.add(glm::dot(view.eye, view.axes[2]) - view.curve.near);
}

Key query_key(const TruthQuery& query) {
    Key key;
    const Emitter& e = query.emitter;
    const TruthOptions& o = query.options;
    key.add(e.type).add(e.position_ws).add(e.to_light).add(e.cos_cone).add(e.range_m).add(e.casts).add(o.area).add(o.as_rasterised);
    key.add(o.nearest);
    if (o.area) key.add(e.size).add(o.samples).add(o.noise);
    for (const ObjectTraits& t : query.traits) key.add(t.receives).add(t.cull);
    for (const LightView& view : query.views) add_near_plane(key, view);
    return key;
}

template <typename Make>
auto timed(double& ms, Make&& make) {
    const auto start = std::chrono::steady_clock::now();
    auto result = make();
    ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return result;
}

}  // namespace

TruthTask truth_task(Renderer& renderer, const Scene& scene, const Settings& settings, const FrameRequest& request,
                     int light, const TruthOptions& options, const std::shared_ptr<const TruthGeometry>& known) {
    FrameRequest wanted = request;
    wanted.outputs = {.colour = false, .surface_ids = true};
    wanted.timing = wanted.force = false;
    const FrameResult frame = renderer.render(scene, settings, wanted);
    TruthTask task;
    task.query = truth_query(scene, settings, frame.lights, light, options);
    const bool same = known && known->key == truth_geometry_key(scene, settings).value();
    task.geometry = same ? known : std::make_shared<TruthGeometry>(scene, settings);
    task.camera = frame.camera;
    task.ids = renderer.read_surface_ids(frame.surface_ids);
    task.lights = frame.lights;
    task.map_resolution = frame.map_resolution;
    Key receivers;
    receivers.add(scene.id).add(frame.camera.clip_from_relative(frame.camera.eye)).add(frame.camera.eye);
    receivers.add(request.width).add(request.height);
    task.receivers_key = receivers.value();
    task.key = query_key(task.query).add(receivers).add(task.geometry->key).value();
    return task;
}

TracedTruth TruthCache::trace(const TruthTask& task, const Workers& workers) {
    TracedTruth out;
    if (!scene_ || scene_->geometry().key != task.geometry->key) {
        scene_.reset();  // the old hierarchy's memory first
        scene_ = timed(out.build_ms,
                       [&] { return std::make_shared<TruthScene>(task.geometry, workers.part(0, 0.1)); });
    }
    if (!receivers_ || receivers_key_ != task.receivers_key) {
        receivers_ = timed(out.place_ms, [&] {
            return std::make_shared<Receivers>(
                place_receivers(*task.geometry, task.camera, task.ids, workers.part(0.1, 0.2)));
        });
        receivers_key_ = task.receivers_key;
    }
    auto found = std::find_if(truths_.begin(), truths_.end(), [&](const auto& t) { return t.first == task.key; });
    if (found == truths_.end()) {
        auto truth = timed(out.trace_ms, [&] {
            return std::make_shared<Truth>(trace_visibility(*scene_, *receivers_, task.query, workers.part(0.2, 1)));
        });
        truths_.emplace_front(task.key, std::move(truth));
        if (truths_.size() > kKept) truths_.pop_back();
    } else {
        truths_.splice(truths_.begin(), truths_, found);
    }
    out.scene = scene_, out.receivers = receivers_, out.truth = truths_.front().second;
    return out;
}

}  // namespace si
