// The panel Lab: placement of the scene, error of single precision, shimmer of shadow edges.
#pragma once

#include <optional>
#include <span>

#include "renderer/measure/pipelines.h"
#include "renderer/measure/shimmer.h"
#include "ui/panels/tune_controls.h"

namespace si {

struct FrameResult;
struct Scene;

/// State of the panel Lab: options of its measurement of shimmering shadow edges.
struct LabPanel {
    ShimmerOptions shimmer;
};

/// Result of the measurement of shimmering shadow edges for one variant of the settings, with the variant's name.
struct ShimmerShown {
    std::string_view label;  ///< name of the variant
    Shimmer shimmer;
};

/// Data that the panel Lab shows: progress and last results of its measurements.
struct LabFacts {
    std::optional<SearchProgress> comparing_pipelines;  ///< none: not under way
    std::optional<SearchProgress> measuring_shimmer;    ///< none: not under way
    std::span<const PipelineError> pipelines;           ///< last result for this scene; empty: none
    std::span<const ShimmerShown> shimmer;              ///< last result for this scene; empty: none
    ShimmerOptions shimmer_of;                          ///< options of `shimmer`
    bool pipelines_current = false;                     ///< `pipelines` belong to the present settings and size
    bool shimmer_current = false;                       ///< `shimmer` is of the present settings and size
};

/// Requests of the panel Lab to the application: start or cancel measurements of numerical precision and of shimmer.
struct LabRequests {
    bool compare_pipelines = false;
    bool cancel_pipelines = false;
    std::optional<ShimmerOptions> measure_shimmer;
    bool cancel_shimmer = false;
};

/// Draws the panel Lab: placement of the scene, error of single against double precision, shimmer of shadow edges.
/// @param scene null: none is loaded @param result the last frame; null: none
void draw_lab(LabPanel& panel, Settings& settings, const Scene* scene, const FrameResult* result, const LabFacts& facts,
              LabRequests& requests);

}  // namespace si
