#include "app/editor/optimisation_times.h"

#include "app/context/headless_context.h"

namespace si {

void EditorOptimisationTimes::start(const Scene& scene, const Settings& settings, const FrameRequest& request) {
    job_.start(
        [copy = std::make_shared<const Scene>(scene), settings, request](const Workers& workers, const auto& report) {
            OptimisationTimesFound out{
                .times = {}, .scene = copy->id, .settings = settings, .width = request.width, .height = request.height};
            const HeadlessContext context;
            Renderer renderer;
            FrameRequest unforced = request;
            unforced.forced = {};  // a forced optimisation skips nothing that could be timed
            const FrameResult frame = renderer.render(*copy, settings, unforced);
            const std::vector<Effect> effects = frame_effects(*copy, settings, frame);
            const std::vector<Optimisation> named = optimisations_of(effects);
            out.times = measure_saved_times(renderer, *copy, settings, unforced, named, kSavedTimeRounds, workers,
                                            [&](double share) {
                                                report({"alternating frames", share});
                                            });
            return out;
        },
        {"the first frame", 0});
}

void EditorOptimisationTimes::fill(EffectsFacts& shown, std::uint64_t scene, const Settings& settings, int width,
                                   int height) const {
    shown.measuring_optimisations = job_.progress();
    if (!found_ || found_->scene != scene) return;
    shown.saved = &found_->times;
    shown.saved_times_current = found_->settings == settings && found_->width == width && found_->height == height;
}

}  // namespace si
