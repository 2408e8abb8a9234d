// Traced reference as a per-pixel input of frames.
//
//     TruthTask task = truth_task(renderer, scene, settings, request, light, truth_options(settings));
//     request.truth = truth_picture(task, cache.trace(task));                // any thread
//     FrameResult frame = renderer.render(scene, settings, request);         // frame.truth.met, frame.error
#pragma once

#include <memory>
#include <optional>

#include "renderer/reference/truth_task.h"

namespace si {

/// Traced reference that a frame compares its shadows with.
struct TruthPicture {
    std::uint64_t key = 0;      ///< truth_key() of the frames that may use it
    std::uint64_t version = 0;  ///< unique per content
    int step = 1;               ///< pixels of the frame per pixel of the reference
    TracedTruth traced;
    std::optional<TruthOptions> options;  ///< override truth.* of the settings
};

/// Wraps a traced reference as input of frames. @param options override truth_options() of the frames' settings
std::shared_ptr<const TruthPicture> truth_picture(const TruthTask& task, const TracedTruth& traced,
                                                  const std::optional<TruthOptions>& options = {});

/// Traces the shadows of all lights whose source (light.source) is ray tracing or a light map, unless `request`,
/// `cache` or light_maps() has them. Returns true when there is such a light.
/// @param request receives the results, for the next frame @throws Cancelled, Error
bool trace_sources(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest& request,
                   TruthCache& cache, const Workers& workers = {});

/// Draws a frame with its reference, and with the ray-traced lights of trace_sources(): traces them unless `request` or
/// `cache` has them.
/// @param request receives the reference, for the next frame
/// @param options override truth_options() of the settings
/// @throws Cancelled, Error
FrameResult render_with_truth(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest& request,
                              TruthCache& cache, const Workers& workers = {},
                              const std::optional<TruthOptions>& options = {});

}  // namespace si
