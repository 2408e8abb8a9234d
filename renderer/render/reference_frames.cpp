#include "renderer/render/reference_frames.h"

#include <algorithm>

#include "renderer/reference/light_map_cache.h"
#include "renderer/settings/sources.h"

namespace si {
namespace {

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

ReferenceTask reference_task(Renderer& renderer, const Scene& scene, const Settings& settings,
                             const FrameRequest& request, int light, const ReferenceOptions& options) {
    FrameRequest wanted = request;
    wanted.outputs = {.colour = false, .surface_ids = true};
    wanted.timing = wanted.force = false;
    const FrameResult frame = renderer.render(scene, settings, wanted);
    return reference_task(scene, settings, frame, renderer.read_surface_ids(frame.surface_ids), request.width,
                          request.height, light, options);
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
    // A reference traced with other options does not match.
    if (request.reference && request.reference->options != options) request.reference.reset();
    const ReferenceOptions wanted = options.value_or(reference_options(settings));
    const auto trace = [&] {
        const ReferenceTask task = reference_task(renderer, scene, settings, request, settings.view.light, wanted);
        request.reference = reference_picture(task, cache.trace(task, workers), options);
    };
    if (!request.reference && options) trace();  // otherwise the drawn frame reports whether it needs one
    FrameResult frame = renderer.render(scene, settings, request);
    if (frame.reference.key == 0 || frame.reference.met) return frame;
    trace();
    return renderer.render(scene, settings, request);
}

}  // namespace si
