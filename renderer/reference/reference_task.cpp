#include "renderer/reference/reference_task.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "renderer/base/key.h"
#include "renderer/reference/ray_scenes.h"
#include "renderer/reference/traced_so_far.h"
#include "renderer/reference/umbra_cache.h"

namespace si {
namespace {

/// Adds a view's axes and near plane to a key. Size and resolution of the map do not affect the reference.
void add_view(Key& key, const LightView& view) {
    key.add(view.axes[0]).add(view.axes[2]).add(view.curve.perspective).add(view.clamps_near).add(view.warped());
    if (view.warped()) return;
    if (view.curve.perspective)
        key.add(view.eye).add(view.curve.near);
    else
        key.add(glm::dot(view.eye, view.axes[2]) - view.curve.near);
}

Key query_key(const ReferenceQuery& query) {
    Key key;
    const Emitter& e = query.emitter;
    const ReferenceOptions& o = query.options;
    key.add(e.type)
        .add(e.position_ws)
        .add(e.to_light)
        .add(e.cos_cone)
        .add(e.range_m)
        .add(e.casts)
        .add(o.area)
        .add(o.as_rasterised);
    key.add(o.nearest).add(o.step);
    if (o.area) key.add(e.size).add(o.samples).add(o.noise);
    for (const ObjectTraits& t : query.traits) key.add(t.receives).add(t.cull);
    for (const LightView& view : query.views) add_view(key, view);
    if (query.chooser.choice == ViewChoice::Interval) key.add(query.chooser.from_ws).add(query.chooser.forward);
    for (const ViewSpan& span : query.chooser.spans) key.add(int(query.chooser.choice)).add(span.ends);
    return key;
}

Key receivers_key(const Scene& scene, const Camera& camera, const PixelRaster& raster) {
    Key key;
    key.add(scene.id).add(camera.clip_from_relative(camera.eye)).add(camera.eye);
    return key.add(raster.width).add(raster.height).add(raster.step);
}

SurfaceIds subsample(const SurfaceIds& all, const PixelRaster& raster) {
    if (raster.step == 1) return all;
    SurfaceIds out{raster.columns(), raster.rows(), {}};
    out.data.reserve(std::size_t(out.width) * std::size_t(out.height));
    for (int y = 0; y < raster.height; y += raster.step)
        for (int x = 0; x < raster.width; x += raster.step)
            out.data.push_back(all.data[std::size_t(y) * std::size_t(raster.width) + std::size_t(x)]);
    return out;
}

template <typename Make>
auto timed(double& ms, Make&& make) {
    const auto start = std::chrono::steady_clock::now();
    auto result = make();
    ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return result;
}

}  // namespace

FloatImage subsample(FloatImage image, int step) {
    if (step <= 1) return image;
    FloatImage out{(image.width + step - 1) / step, (image.height + step - 1) / step, image.channels, {}};
    out.data.reserve(std::size_t(out.width) * std::size_t(out.height) * std::size_t(out.channels));
    for (int y = 0; y < image.height; y += step)
        for (int x = 0; x < image.width; x += step)
            for (int c = 0; c < image.channels; ++c) out.data.push_back(image.at(x, y, c));
    return out;
}

std::uint64_t reference_key(const Scene& scene, const Settings& settings, const Camera& camera, int width, int height,
                            const std::vector<FittedLight>& lights, int light, const ReferenceOptions& options) {
    if (light < 0 || std::size_t(light) >= lights.size()) return 0;
    const PixelRaster raster{width, height, std::max(options.step, 1)};
    return query_key(reference_query(scene, settings, lights, light, options))
        .add(receivers_key(scene, camera, raster))
        .add(reference_geometry_key(scene, settings).value())
        .value();
}

ReferenceTask reference_task(const Scene& scene, const Settings& settings, const FrameResult& frame,
                             const SurfaceIds& ids, int width, int height, int light, const ReferenceOptions& options) {
    ReferenceTask task;
    task.query = reference_query(scene, settings, frame.lights, light, options);
    task.geometry = ray_scenes().geometry(scene, settings);
    task.camera = frame.camera;
    task.raster = {width, height, std::max(options.step, 1)};
    task.ids = subsample(ids, task.raster);
    task.lights = frame.lights;
    task.map_size = frame.map_size;
    const Key receivers = receivers_key(scene, frame.camera, task.raster);
    task.receivers_key = receivers.value();
    task.key = query_key(task.query).add(receivers).add(task.geometry->key).value();
    return task;
}

TracedReference ReferenceCache::trace(const ReferenceTask& task, const Workers& workers) {
    TracedReference out;
    if (!scene_ || scene_->geometry().key != task.geometry->key) {
        scene_ = ray_scenes().find(task.geometry->key);  // frees the old hierarchy first
        if (!scene_)
            scene_ = timed(out.build_ms,
                           [&] { return ray_scenes().get(task.geometry, workers.with_progress_range(0, 0.1)); });
    }
    if (!receivers_ || receivers_key_ != task.receivers_key) {
        receivers_ = timed(out.place_ms, [&] {
            return std::make_shared<Receivers>(reconstruct_receivers(*task.geometry, task.camera, task.ids, task.raster,
                                                                     workers.with_progress_range(0.1, 0.2)));
        });
        receivers_key_ = task.receivers_key;
    }
    TileDone tile_done;
    if (task.so_far)
        tile_done = [&](const Reference& so_far, glm::ivec2 first, glm::ivec2 end) {
            task.so_far->add_tile(so_far, first, end);
        };
    auto found =
        std::find_if(references_.begin(), references_.end(), [&](const Known& t) { return t.key == task.key; });
    if (found == references_.end()) {
        Known known{.key = task.key,
                    .receivers_key = task.receivers_key,
                    .reference = {},
                    .runs = {},
                    .query = std::make_shared<ReferenceQuery>(task.query),
                    .umbra = std::make_shared<UmbraCache>(),
                    .version = next_version()};
        known.reference = timed(out.trace_ms, [&] {
            return std::make_shared<Reference>(
                trace_visibility(*scene_, *receivers_, task.query, workers.with_progress_range(0.2, 0.9), tile_done));
        });
        const auto same = std::ranges::find_if(references_, [&](const Known& other) {
            return other.receivers_key == task.receivers_key &&
                   have_same_runs(*known.reference, task.query, *other.reference, *other.query);
        });
        known.runs =
            same != references_.end()
                ? same->runs
                : std::make_shared<ShadowRuns>(shadow_runs(*known.reference, *receivers_, task.camera, task.raster,
                                                           task.query, workers.with_progress_range(0.9, 1)));
        references_.push_front(std::move(known));
        if (references_.size() > kMaxReferences) references_.pop_back();
    } else {
        references_.splice(references_.begin(), references_, found);
    }
    out.scene = scene_;
    out.receivers = receivers_;
    out.reference = references_.front().reference;
    out.runs = references_.front().runs;
    out.query = references_.front().query;
    out.umbra = references_.front().umbra;
    out.version = references_.front().version;
    return out;
}

}  // namespace si
