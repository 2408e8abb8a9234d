// Traced reference as a per-pixel input of frames.
//
//     ReferenceTask task = reference_task(renderer, scene, settings, request, light, reference_options(settings));
//     request.reference = reference_picture(task, cache.trace(task));            // any thread
//     FrameResult frame = renderer.render(scene, settings, request);             // frame.reference.met, frame.error
#pragma once

#include <memory>
#include <optional>

#include "renderer/reference/reference_task.h"

namespace si {

/// Ray-traced reference (visibility of one light by pixel) as an input of a frame, for comparison with the frame's
/// shadows or as their source.
struct ReferencePicture {
    std::uint64_t key = 0;      ///< reference_key() of the frames that may use it
    std::uint64_t version = 0;  ///< unique per content
    int step = 1;               ///< pixels of the frame per pixel of the reference
    TracedReference traced;
    std::optional<ReferenceOptions> options;  ///< replace the settings truth.*; nullopt: truth.* apply
};

/// Wraps a ray-traced reference as an input of frames (FrameRequest::reference, FrameRequest::traced).
/// @param options replace the settings truth.* of the frames; nullopt: truth.* apply
std::shared_ptr<const ReferencePicture> reference_picture(const ReferenceTask& task, const TracedReference& traced,
                                                          const std::optional<ReferenceOptions>& options = {});

}  // namespace si
