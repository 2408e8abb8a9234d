#include "renderer/reference/truth_picture.h"

#include <algorithm>
#include <atomic>

#include "renderer/reference/light_map_cache.h"
#include "renderer/settings/sources.h"

namespace si {
namespace {

std::uint64_t next_version() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

/// Bakes the light maps that lights need and `request` lacks. Returns whether any needs one.
bool bake_sources(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest& request,
                  const Workers& workers) {
    if (!any_source_needs(settings, &SourceNeeds::light_map)) return false;
    FrameRequest asks = request;
    asks.outputs = {.colour = false};
    asks.timing = asks.force = false;
    const FrameResult frame = renderer.render(scene, settings, asks);
    for (std::size_t i = 0; i < frame.light_maps.size(); ++i) {
        if (frame.light_maps[i].key == 0 || frame.light_maps[i].met) continue;
        request.light_maps.resize(std::max(request.light_maps.size(), i + 1));
        request.light_maps[i] = light_maps().get(light_map_task(scene, settings, frame, int(i)), workers);
    }
    return true;
}

}  // namespace

std::shared_ptr<const ReferencePicture> reference_picture(const ReferenceTask& task, const TracedReference& traced,
                                                          const std::optional<ReferenceOptions>& options) {
    auto picture = std::make_shared<ReferencePicture>();
    picture->key = task.key;
    picture->version = next_version();
    picture->step = task.raster.step;
    picture->traced = traced;
    picture->options = options;
    return picture;
}

bool trace_sources(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest& request,
                   ReferenceCache& cache, const Workers& workers) {
    bool any = false;
    for (int i = 0; i < std::clamp(settings.light_count, 0, kMaxLights); ++i) {
        if (!settings.lights[std::size_t(i)].cast || !source_of(settings, i).needs.reference) continue;
        any = true;
        request.traced.resize(std::max(request.traced.size(), std::size_t(i) + 1));
        auto& known = request.traced[std::size_t(i)];
        const ReferenceTask task = reference_task(renderer, scene, settings, request, i, reference_options(settings));
        if (!known || known->key != task.key) known = reference_picture(task, cache.trace(task, workers));
    }
    return bake_sources(renderer, scene, settings, request, workers) || any;
}

FrameResult render_with_reference(Renderer& renderer, const Scene& scene, const Settings& settings,
                                  FrameRequest& request, ReferenceCache& cache, const Workers& workers,
                                  const std::optional<ReferenceOptions>& options) {
    trace_sources(renderer, scene, settings, request, cache, workers);
    // What the picture at hand was asked for is not what this one is.
    if (request.reference && request.reference->options != options) request.reference.reset();
    const ReferenceOptions wanted = options.value_or(reference_options(settings));
    const auto trace = [&] {
        const ReferenceTask task = reference_task(renderer, scene, settings, request, settings.view.light, wanted);
        request.reference = reference_picture(task, cache.trace(task, workers), options);
    };
    if (!request.reference && options) trace();  // else the frame tells whether it asks for any
    FrameResult frame = renderer.render(scene, settings, request);
    if (frame.reference.key == 0 || frame.reference.met) return frame;
    trace();
    return renderer.render(scene, settings, request);
}

}  // namespace si
