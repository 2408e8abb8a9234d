// Background measurements of the panel Lab: precision of matrix pipelines, shimmer of shadow edges.
#pragma once

#include "app/editor/search.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Scene, settings and picture size that a measurement of the panel Lab is about.
struct LabSubject {
    std::uint64_t scene = 0;  ///< Scene::id
    Settings settings;
    int width = 0;   ///< pixels of the picture
    int height = 0;  ///< pixels of the picture
};

/// Errors of all single-precision matrix pipelines, with the scene and settings they belong to.
struct PipelinesFound {
    std::vector<PipelineError> errors;
    LabSubject of;
};

/// Background comparison of single-precision matrix pipelines: one at a time, on a thread of its own.
class EditorPipelines : public EditorSearch<PipelinesFound> {
public:
    EditorPipelines() : EditorSearch("The comparison of precision was cancelled") {}
    /// Starts a comparison of matrix pipelines and cancels the one under way.
    void start(const Scene& scene, const LabSubject& of);
    /// Writes progress and results of the comparison into the panel's facts.
    /// @param present scene and settings; results of other ones are marked as old
    void fill(LabFacts& shown, const LabSubject& present) const;
};

/// Shimmer of shadow edges under each variant of the settings, with the scene and settings they belong to.
struct ShimmerFound {
    std::vector<ShimmerShown> variants;
    ShimmerOptions options;
    LabSubject of;
};

/// Background measurement of shimmering shadow edges: one at a time, on a thread of its own.
class EditorShimmer : public EditorSearch<ShimmerFound> {
public:
    EditorShimmer() : EditorSearch("The measurement of shimmer was cancelled") {}
    /// Starts a measurement of shimmer and cancels the one under way.
    void start(const Scene& scene, const LabSubject& of, const ShimmerOptions& options);
    /// Writes progress and results of the shimmer measurement into the panel's facts.
    /// @param present scene and settings; results of other ones are marked as old
    void fill(LabFacts& shown, const LabSubject& present) const;
};

}  // namespace si
