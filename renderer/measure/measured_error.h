// Measurement of one light's shadow errors in one frame, with their causes.
//
//     ReferenceCache cache;
//     MeasuredError measured = measure_error(renderer, scene, settings, request, light, {}, cache);
//     measured.metrics.acne, measured.classified[y * width + x].artefact
#pragma once

#include <functional>

#include "renderer/reference/metrics.h"
#include "renderer/render/reference_frames.h"

namespace si {

/// Picture of a frame with the drawn shadows, and the same picture with the ray-traced reference's shadows for one
/// light. Neither has overlays. Metrics such as FLIP compare the two.
struct PicturePair {
    ByteImage drawn, by_reference;
};

/// Shadow error of one light in one frame: the reference (ray-traced shadows), the class of every pixel, and metrics
/// over the pixels.
struct MeasuredError {
    TracedReference traced;
    ErrorMetrics metrics;
    std::vector<ClassifiedPixel> classified;  ///< one per pixel of the reference, top row first
    std::vector<FittedLight> lights;          ///< lights of the frame
    Camera camera;
    int light = 0, map_resolution = 0;
    MapSize map_size;
    double reach_texels = 0;  ///< reach of the kernel and of the depth blur (map.blur_texels); 0 without a map
    glm::ivec2 picture{0};    ///< size of the frame; the reference may have fewer pixels
    std::optional<PicturePair> pictures;  ///< pictures for Metric::of_pictures; none once such metrics are computed
};

/// Callback that decides whether the causes of a frame's wrong pixels are needed. Called when all pixels are compared
/// with the reference, but no cause is known.
using NeedsCauses = std::function<bool(const MeasuredError& compared)>;

/// Measures a light's shadow error in a frame. Traces the reference (ray-traced shadows) unless `cache` has it, draws
/// the frame, classifies its pixels and computes the metrics. Call on the renderer's thread.
/// @param light index of the light in the settings light.*
/// @param of_pictures true: also draws pictures and computes metrics of them (Metric::of_pictures)
/// @param needs_causes called once all pixels are compared. If it returns false, causes are not searched for: wrong
/// pixels keep Artefact::None, ErrorMetrics::without_cause counts them, and metrics that need causes or rays are NaN.
/// Empty: causes are needed
/// @throws Cancelled; Error when there is no such light, or as Renderer::render() does
MeasuredError measure_error(Renderer& renderer, const Scene& scene, const Settings& settings,
                            const FrameRequest& request, int light, const ReferenceOptions& options,
                            ReferenceCache& cache, const Workers& workers = {}, bool of_pictures = false,
                            const NeedsCauses& needs_causes = {});

/// Draws a frame twice: with its own shadows, and with those of the ray-traced reference for the light view.light. Used
/// by metrics that compare pictures (Metric::of_pictures).
/// @param request frame to draw, with its reference
PicturePair draw_picture_pair(Renderer& renderer, const Scene& scene, const Settings& settings,
                              const FrameRequest& request);

/// Reads back the class of shadow error of each pixel of a drawn frame. Call sum_error_metrics() on the result, on any
/// thread, to compute the metrics.
/// @param frame drawn with `picture`, and with Outputs::classified or Outputs::compared
/// @param picture the reference of the frame
/// @param settings settings of the frame; view.light selects the light whose shadow errors are read
MeasuredError read_classified_pixels(Renderer& renderer, const FrameResult& frame, const ReferencePicture& picture,
                                     const Settings& settings);
/// Finds light in the umbra by rays (ClassifiedPixel::any_leak), and computes MeasuredError::metrics from the
/// classified pixels and MeasuredError::pictures. @throws Cancelled
void sum_error_metrics(MeasuredError& measured, const Workers& workers = {});

}  // namespace si
