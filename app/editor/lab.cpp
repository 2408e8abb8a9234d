#include "app/editor/lab.h"

#include "app/context/headless_context.h"
#include "renderer/measure/axes.h"

namespace si {
namespace {

/// Returns true if a measurement is about the present scene, settings and size.
bool holds(const LabSubject& of, const LabSubject& present) {
    return of.scene == present.scene && of.width == present.width && of.height == present.height &&
           measured_settings(of.settings) == measured_settings(present.settings);
}

}  // namespace

void EditorPipelines::start(const Scene& scene, const LabSubject& of) {
    job_.start(
        [copy = std::make_shared<const Scene>(scene), of](const Workers&, const auto&) {
            const HeadlessContext context;
            Renderer renderer;
            return PipelinesFound{compare_pipelines(renderer, *copy, of.settings, of.width, of.height), of};
        },
        {"four pipelines", 0});
}

void EditorPipelines::fill(LabFacts& shown, const LabSubject& present) const {
    shown.comparing_pipelines = job_.progress();
    if (!found_) return;
    shown.pipelines = found_->errors;
    // All pipelines are compared, so that the chosen one does not matter.
    LabSubject of = found_->of;
    of.settings.map.origin = present.settings.map.origin;
    of.settings.map.transform = present.settings.map.transform;
    shown.pipelines_current = holds(of, present);
}

void EditorShimmer::start(const Scene& scene, const LabSubject& of, const ShimmerOptions& options) {
    job_.start(
        [copy = std::make_shared<const Scene>(scene), of, options](const Workers& workers, const auto& report) {
            ShimmerFound out{{}, options, of};
            const HeadlessContext context;
            Renderer renderer;
            const std::vector<ShimmerVariant> variants = shimmer_variants(of.settings);
            for (const ShimmerVariant& v : variants) {
                const double before = double(out.variants.size()) / double(variants.size());
                out.variants.push_back(
                    {v.label,
                     measure_shimmer(renderer, *copy, v.settings, of.width, of.height, options, workers,
                                     [&](double share) {
                                         report({std::string(v.label), before + share / double(variants.size())});
                                     })});
            }
            return out;
        },
        {"the first frame", 0});
}

void EditorShimmer::fill(LabFacts& shown, const LabSubject& present) const {
    shown.measuring_shimmer = job_.progress();
    if (!found_) return;
    shown.shimmer = found_->variants;
    shown.shimmer_of = found_->options;
    shown.shimmer_current = holds(found_->of, present);
}

}  // namespace si
