// Measurement of one light's shadow errors in one frame, with their causes.
//
//     ReferenceCache cache;
//     MeasuredError measured = measure_error(renderer, scene, settings, request, light, {}, cache);
//     measured.metrics.acne, measured.classified[y * width + x].artefact
#pragma once

#include "renderer/reference/metrics.h"
#include "renderer/render/reference_frames.h"

namespace si {

/// Shadow error of one light in one frame: the reference, every pixel's classification, and metrics over them.
struct MeasuredError {
    TracedReference traced;
    ErrorMetrics metrics;
    std::vector<ClassifiedPixel> classified;  ///< one per pixel of the reference, top row first
    std::vector<FittedLight> lights;          ///< lights of the frame
    Camera camera;
    int light = 0, map_resolution = 0;
    double reach_texels = 0;  ///< reach of the kernel and of the depth blur (map.blur_texels); 0 without a map
    glm::ivec2 picture{0};    ///< size of the frame; the reference may have fewer pixels
};

/// Measures a light's shadow error in a frame: traces the reference unless `cache` has it, draws the frame, classifies
/// its pixels and computes the metrics. Call on the renderer's thread.
/// @param light index of light.*
/// @throws Cancelled; Error when there is no such light, or as Renderer::render() does
MeasuredError measure_error(Renderer& renderer, const Scene& scene, const Settings& settings,
                            const FrameRequest& request, int light, const ReferenceOptions& options,
                            ReferenceCache& cache, const Workers& workers = {});

/// Reads back the classified pixels of a frame that was drawn with `picture` and Outputs::classified, without metrics:
/// sum_error_metrics() computes those, on any thread.
/// @param settings settings of the frame, whose view.light is classified
MeasuredError read_classified_pixels(Renderer& renderer, const FrameResult& frame, const ReferencePicture& picture,
                                     const Settings& settings);
/// Finds light in the umbra by rays (ClassifiedPixel::any_leak), and computes MeasuredError::metrics from the
/// classified pixels. @throws Cancelled
void sum_error_metrics(MeasuredError& measured, const Workers& workers = {});

}  // namespace si
