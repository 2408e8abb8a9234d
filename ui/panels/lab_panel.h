// The lab: where a scene is put, what single precision makes of it, and how much shadows crawl. What the panel is set
// to, shows and wishes for.
#pragma once

#include <optional>
#include <span>

#include "renderer/measure/pipelines.h"
#include "renderer/measure/shimmer.h"
#include "ui/panels/tune.h"

namespace si {

struct FrameResult;
struct Scene;

struct LabPanel {
    ShimmerOptions shimmer;
};

struct ShimmerShown {
    std::string_view label;  ///< of the variant
    Shimmer shimmer;
};

struct LabFacts {
    std::optional<SearchProgress> comparing_pipelines, measuring_shimmer;  ///< under way
    std::span<const PipelineError> pipelines;  ///< measured last, of this scene; empty: none
    std::span<const ShimmerShown> shimmer;
    ShimmerOptions shimmer_of;                                ///< what `shimmer` was measured with
    bool pipelines_current = false, shimmer_current = false;  ///< of the present settings and picture
};

struct LabRequests {
    bool compare_pipelines = false;
    bool cancel_pipelines = false;
    std::optional<ShimmerOptions> measure_shimmer;
    bool cancel_shimmer = false;
};

/// Draws the panel Lab: placement of the scene, error of single precision, shimmer of shadow edges.
/// @param scene null: none is loaded @param result of the last frame; null: none
void draw_lab(LabPanel& panel, Settings& settings, const Scene* scene, const FrameResult* result, const LabFacts& facts,
              LabRequests& requests);

}  // namespace si
