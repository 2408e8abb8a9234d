// Background measurements of the panel Lab: precision of matrix pipelines, shimmer of shadow edges.
#pragma once

#include "app/editor/search.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Scene, settings and size that a measurement is about.
struct LabSubject {
    std::uint64_t scene = 0;  ///< Scene::id
    Settings settings;
    int width = 0;   ///< pixels of the picture
    int height = 0;  ///< pixels of the picture
};

/// Result of a comparison of pipelines.
struct PipelinesFound {
    std::vector<PipelineError> errors;
    LabSubject of;
};

/// One comparison of single-precision matrix pipelines at a time, on a thread of its own.
class EditorPipelines : public EditorSearch<PipelinesFound> {
public:
    EditorPipelines() : EditorSearch("The comparison of precision was cancelled") {}
    /// Starts a comparison and cancels the one under way.
    void start(const Scene& scene, const LabSubject& of);
    /// Writes progress and results into `shown`, marked as current only if they are about `present`.
    void fill(LabFacts& shown, const LabSubject& present) const;
};

/// Result of a measurement of shimmer.
struct ShimmerFound {
    std::vector<ShimmerShown> variants;
    ShimmerOptions options;
    LabSubject of;
};

/// One measurement of shimmer at a time, on a thread of its own.
class EditorShimmer : public EditorSearch<ShimmerFound> {
public:
    EditorShimmer() : EditorSearch("The measurement of shimmer was cancelled") {}
    /// Starts a measurement and cancels the one under way.
    void start(const Scene& scene, const LabSubject& of, const ShimmerOptions& options);
    /// Writes progress and results into `shown`, marked as current only if they are about `present`.
    void fill(LabFacts& shown, const LabSubject& present) const;
};

}  // namespace si
