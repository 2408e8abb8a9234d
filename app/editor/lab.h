// What the lab measures in the background.
#pragma once

#include "app/editor/search.h"
#include "ui/state/editor_ui.h"

namespace si {

/// What a measurement is about.
struct LabOf {
    std::uint64_t scene = 0;  ///< Scene::id
    Settings settings;
    int width = 0, height = 0;
};

struct PipelinesFound {
    std::vector<PipelineError> errors;
    LabOf of;
};

class EditorPipelines : public EditorSearch<PipelinesFound> {
public:
    EditorPipelines() : EditorSearch("Comparing ways was cancelled") {}
    void start(const Scene& scene, const LabOf& of);
    void fill(LabFacts& shown, const LabOf& present) const;
};

struct ShimmerFound {
    std::vector<ShimmerShown> variants;
    ShimmerOptions options;
    LabOf of;
};

class EditorShimmer : public EditorSearch<ShimmerFound> {
public:
    EditorShimmer() : EditorSearch("Measuring shimmer was cancelled") {}
    void start(const Scene& scene, const LabOf& of, const ShimmerOptions& options);
    void fill(LabFacts& shown, const LabOf& present) const;
};

}  // namespace si
