// A traced truth as frames take it: per pixel.
//
//     ReferenceTask task = reference_task(renderer, scene, settings, request, light, reference_options(settings));
//     request.truth = reference_picture(task, cache.trace(task));                // any thread
//     FrameResult frame = renderer.render(scene, settings, request);         // frame.truth.met, frame.error
#pragma once

#include <memory>
#include <optional>

#include "renderer/reference/reference_task.h"

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

}  // namespace si
