// A traced truth as frames take it: per pixel.
//
//     TruthTask task = truth_task(renderer, scene, settings, request, light, truth_options(settings));
//     request.truth = truth_picture(task, cache.trace(task));                // any thread
//     FrameResult frame = renderer.render(scene, settings, request);         // frame.truth.met, frame.error
#pragma once

#include <memory>
#include <optional>

#include "renderer/reference/reference_task.h"

namespace si {

struct TruthPicture {
    std::uint64_t key = 0;      ///< truth_key() of the frames that it is for
    std::uint64_t version = 0;  ///< another one for each content
    int step = 1;               ///< pixels of the frame per pixel of the truth
    TracedTruth traced;
    std::optional<TruthOptions> options;  ///< asked for in place of what truth.* of the settings say
};

/// @param options if given, frames take the truth of these in place of truth_options() of their settings
std::shared_ptr<const TruthPicture> truth_picture(const TruthTask& task, const TracedTruth& traced,
                                                  const std::optional<TruthOptions>& options = {});

}  // namespace si
