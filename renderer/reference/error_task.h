// How wrong a light's shadows are in one frame, and why.
//
//     ErrorTask task = error_task(renderer, scene, settings, request, light, {}, cache.geometry());  // renderer's thread
//     MeasuredError measured = measure_error(task, cache, {.stop = token, .progress = report});       // any one thread
//     measured.metrics.acne, measured.artefacts[y * width + x]
#pragma once

#include "renderer/reference/metrics.h"
#include "renderer/reference/truth_task.h"

namespace si {

struct ErrorTask {
    TruthTask truth;
    FloatImage measured;         ///< visibility as the settings draw it, by pixel of the truth
    FloatImage map_coordinates;  ///< FrameResult::map_coordinates likewise; empty when the light has no map
    BiasSettings bias;
    int light = 0;
    double reach_texels = 0.5;   ///< of the kernel, kappa
};

/// Draws visibility, the places of the kernels and which triangle each pixel shows.
ErrorTask error_task(Renderer& renderer, const Scene& scene, const Settings& settings, const FrameRequest& request,
                     int light, const TruthOptions& options = {},
                     const std::shared_ptr<const TruthGeometry>& known = nullptr);

struct MeasuredError {
    TracedTruth traced;
    ErrorMetrics metrics;
    std::vector<Artefact> artefacts;  ///< by pixel, top row first
    PixelFacts facts;
    double classify_ms = 0;           ///< wall time beside the truth's
};

/// Compares with a truth that is known. @throws Cancelled, Error
MeasuredError compare_with_truth(const ErrorTask& task, TracedTruth traced, const Workers& workers = {});

/// Traces the truth and compares. @throws Cancelled, Error
MeasuredError measure_error(const ErrorTask& task, TruthCache& cache, const Workers& workers = {});

/// Where the kernel of each pixel looks whose two visibilities differ inside the map; others have no view.
/// @param facts if not null, gets outside_map, bias_m and joins. @throws Cancelled
std::vector<Footprint> differing_footprints(const FloatImage& measured, const FloatImage& map_coordinates,
                                            const TracedTruth& traced, const FittedLight& light, const BiasSettings& bias,
                                            int map_resolution, PixelFacts* facts, const Workers& workers);

/// How far from the receiver, in texels, the centre of a texel that the kernel compares may lie, per axis.
double kernel_reach_texels(const Settings& settings);

}  // namespace si
