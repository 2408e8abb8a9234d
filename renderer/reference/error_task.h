// How wrong a light's shadows are in one frame, and why.
//
//     ReferenceCache cache;
//     MeasuredError measured = measure_error(renderer, scene, settings, request, light, {}, cache);
//     measured.metrics.acne, measured.judged[y * width + x].artefact
#pragma once

#include "renderer/reference/metrics.h"
#include "renderer/reference/truth_picture.h"

namespace si {

struct MeasuredError {
    TracedReference traced;
    ErrorMetrics metrics;
    std::vector<JudgedPixel> classified;  ///< by pixel of the truth, top row first
    std::vector<FittedLight> lights;      ///< of the frame
    Camera camera;
    int light = 0, map_resolution = 0;
    glm::ivec2 picture{0};  ///< size of the frame, of which the truth may be a part
};

/// Traces the truth about `light` unless `cache` has it, draws the frame that is judged by it, and sums up.
/// On the renderer's thread. @throws Cancelled; Error when there is no such light, or as Renderer::render() does
MeasuredError measure_error(Renderer& renderer, const Scene& scene, const Settings& settings,
                            const FrameRequest& request, int light, const ReferenceOptions& options,
                            ReferenceCache& cache, const Workers& workers = {});

/// What a frame found that was drawn with `picture` and asked for Outputs::judged. It need not be summed up where it
/// was read: sum_up() takes any thread.
MeasuredError read_classified(Renderer& renderer, const FrameResult& frame, const ReferencePicture& picture, int light);
/// Fills MeasuredError::metrics.
void sum_up(MeasuredError& measured);

/// What of the settings and the scene's casters the causes of a light's errors depend on.
CauseContext cause_context(const Settings& settings, const FittedLight& light, int map_resolution, bool mask_levels);

}  // namespace si
