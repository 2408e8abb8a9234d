// A traced truth as frames take it: per pixel.
//
//     ReferenceTask task = reference_task(renderer, scene, settings, request, light, reference_options(settings));
//     request.truth = reference_picture(task, cache.trace(task));                // any thread
//     FrameResult frame = renderer.render(scene, settings, request);         // frame.truth.met, frame.error
#pragma once

#include <memory>
#include <optional>

#include "renderer/reference/truth_task.h"

namespace si {

struct ReferencePicture {
    std::uint64_t key = 0;      ///< reference_key() of the frames that it is for
    std::uint64_t version = 0;  ///< another one for each content
    int step = 1;               ///< pixels of the frame per pixel of the truth
    TracedReference traced;
    std::optional<ReferenceOptions> options;  ///< asked for in place of what truth.* of the settings say
};

/// @param options if given, frames take the truth of these in place of reference_options() of their settings
std::shared_ptr<const ReferencePicture> reference_picture(const ReferenceTask& task, const TracedReference& traced,
                                                          const std::optional<ReferenceOptions>& options = {});

/// Traces what lights need whose source is ray traced or a light map, unless `request`, `cache` or light_maps() has it.
/// Returns whether any does.
/// @param request keeps what was traced for the next frame @throws Cancelled, Error
bool trace_sources(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest& request,
                   ReferenceCache& cache, const Workers& workers = {});

/// Draws a frame that has all rays it asks for, those of trace_sources() too: traced unless `request` or `cache` has
/// them.
/// @param request keeps the truth for the next frame
/// @param options in place of reference_options() of the settings
/// @throws Cancelled, Error
FrameResult render_with_reference(Renderer& renderer, const Scene& scene, const Settings& settings,
                                  FrameRequest& request, ReferenceCache& cache, const Workers& workers = {},
                                  const std::optional<ReferenceOptions>& options = {});

}  // namespace si
