// Tasks that trace a frame's reference: inputs are collected on the renderer's thread, then traced and cached on any
// thread.
//
//     ReferenceCache cache;                                                             // lives as long as the session
//     ReferenceTask task = reference_task(renderer, scene, settings, request, light, {.area = true});
//     TracedReference traced = cache.trace(task, {.stop = token, .progress = report});  // on any one thread
//     traced.reference->visibility.at(x, y);
#pragma once

#include <cstdint>
#include <list>
#include <memory>

#include "renderer/frame/frame.h"
#include "renderer/reference/shadow_runs.h"

namespace si {

class TracedSoFar;

/// Input for tracing a reference, independent of scene and GPU: any thread may trace it.
struct ReferenceTask {
    std::shared_ptr<const ReferenceGeometry> geometry;
    Camera camera;
    PixelRaster raster;
    SurfaceIds ids;  ///< triangle of each sampled pixel
    ReferenceQuery query;
    std::vector<FittedLight> lights;  ///< lights of the frame
    MapSize map_size;
    std::shared_ptr<TracedSoFar> so_far;  ///< receives pixels as they are traced; null: progress is not shown
    std::uint64_t receivers_key = 0;
    std::uint64_t key = 0;  ///< reference_key(): scene, objects, camera, size, light, options; not the map's resolution
};

/// Returns the cache key of the reference of one light for one picture. 0 when there is no such light.
/// @param width,height size of the picture, pixels @param light index in `lights`
std::uint64_t reference_key(const Scene& scene, const Settings& settings, const Camera& camera, int width, int height,
                            const std::vector<FittedLight>& lights, int light, const ReferenceOptions& options);

/// Returns every `step`-th pixel of an image, across and down, from the top left.
FloatImage subsample(FloatImage image, int step);

/// Collects the input for tracing the reference of one light in a drawn frame. Triangles are shared with the scene, or
/// with a hierarchy in ray_scenes(), not copied.
/// @param frame a frame drawn in a picture of `width` x `height` pixels
/// @param ids triangles of all pixels: FrameResult::surface_ids read back
/// @param light index in FrameResult::lights
/// @throws Error when there is no such light
ReferenceTask reference_task(const Scene& scene, const Settings& settings, const FrameResult& frame,
                             const SurfaceIds& ids, int width, int height, int light, const ReferenceOptions& options);

class UmbraCache;

/// Traced reference with everything it was computed from, and the wall time of each step.
struct TracedReference {
    std::shared_ptr<const ReferenceScene> scene;
    std::shared_ptr<const Receivers> receivers;
    std::shared_ptr<const Reference> reference;
    std::shared_ptr<const ShadowRuns> runs;
    std::shared_ptr<const ReferenceQuery> query;      ///< sizes of its views may be those of an earlier frame
    std::shared_ptr<UmbraCache> umbra;                ///< cache of umbra_of()
    std::uint64_t version = 0;                        ///< unique per content of reference and runs, by next_version()
    double build_ms = 0, place_ms = 0, trace_ms = 0;  ///< wall time of hierarchy, receivers, rays; 0: cached
};

/// Cache of the last traced references, with their receivers and ray-tracing hierarchy. Used by one thread at a time.
class ReferenceCache {
public:
    /// Traces the reference of a task, or returns it from the cache.
    /// @throws Cancelled, Error; parts that were complete by then stay in the cache
    TracedReference trace(const ReferenceTask& task, const Workers& workers = {});
    /// Drops all cached references, receivers (surface points of pixels) and ray-tracing hierarchies.
    void clear() { *this = {}; }
    /// Returns the receivers (surface points of pixels) of the reference traced last; null: none.
    const std::shared_ptr<const Receivers>& receivers() const { return receivers_; }

private:
    static constexpr std::size_t kMaxReferences = 4;  ///< for two lights, each without size and as an area light
    std::shared_ptr<const ReferenceScene> scene_;
    std::shared_ptr<const Receivers> receivers_;
    std::uint64_t receivers_key_ = 0;
    /// Cached reference of one light, with the cache key of the task that traced it.
    struct Known {
        std::uint64_t key = 0, receivers_key = 0;
        std::shared_ptr<const Reference> reference;
        std::shared_ptr<const ShadowRuns> runs;
        std::shared_ptr<const ReferenceQuery> query;
        std::shared_ptr<UmbraCache> umbra;
        std::uint64_t version = 0;
    };
    std::list<Known> references_;  ///< most recently used first
};

}  // namespace si
