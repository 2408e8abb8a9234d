// From a frame to its truth: what must be taken on the renderer's thread, and what any thread then computes and keeps.
//
//     ReferenceCache cache;                                                              // lives as long as the
//     session ReferenceTask task = reference_task(renderer, scene, settings, request, light, {.area = true});
//     TracedReference traced = cache.trace(task, {.stop = token, .progress = report});   // on any one thread
//     traced.truth->visibility.at(x, y);
#pragma once

#include <list>
#include <memory>

#include "renderer/frame/renderer.h"
#include "renderer/reference/shadow_runs.h"

namespace si {

/// Everything that a trace needs; it touches neither scene nor GPU any more.
struct ReferenceTask {
    std::shared_ptr<const ReferenceGeometry> geometry;
    Camera camera;
    PixelRaster raster;
    SurfaceIds ids;  ///< of the raster's pixels
    ReferenceQuery query;
    std::vector<FittedLight> lights;  ///< of the frame
    int map_resolution = 0;
    std::uint64_t receivers_key = 0;
    std::uint64_t key = 0;  ///< of the truth: scene, objects, camera, size, light, options; not the map's resolution
};

/// The key of the truth about one light in one picture. 0 when there is no such light.
std::uint64_t reference_key(const Scene& scene, const Settings& settings, const Camera& camera, int width, int height,
                            const std::vector<FittedLight>& lights, int light, const ReferenceOptions& options);

/// Every `step`-th pixel across and down, from the top left.
FloatImage every_nth(const FloatImage& image, int step);

/// Draws which triangle each pixel shows, and shares the scene's triangles unless ray_scenes() have them already.
/// @param light index of light.*. @throws Error when there is no such light, or as Renderer::render() does
ReferenceTask reference_task(Renderer& renderer, const Scene& scene, const Settings& settings,
                             const FrameRequest& request, int light, const ReferenceOptions& options = {});

struct TracedReference {
    std::shared_ptr<const ReferenceScene> scene;
    std::shared_ptr<const Receivers> receivers;
    std::shared_ptr<const Reference> reference;
    std::shared_ptr<const ShadowRuns> runs;
    double build_ms = 0, place_ms = 0, trace_ms = 0, runs_ms = 0;  ///< wall time; 0 where the cache had it
};

/// The last receivers and truths, and the last hierarchy of ray_scenes(). Used by one thread at a time.
class ReferenceCache {
public:
    /// @throws Cancelled, Error; what was complete by then is kept
    TracedReference trace(const ReferenceTask& task, const Workers& workers = {});
    void clear() { *this = {}; }
    /// Of what was traced last; null: nothing.
    const std::shared_ptr<const Receivers>& receivers() const { return receivers_; }

private:
    static constexpr std::size_t kKept = 4;  ///< truths: hard and area of two lights
    std::shared_ptr<const ReferenceScene> scene_;
    std::shared_ptr<const Receivers> receivers_;
    std::uint64_t receivers_key_ = 0;
    struct Known {
        std::uint64_t key = 0;
        std::shared_ptr<const Reference> reference;
        std::shared_ptr<const ShadowRuns> runs;
    };
    std::list<Known> references_;  ///< latest first
};

}  // namespace si
