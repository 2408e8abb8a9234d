#include "app/editor/bias_search.h"

#include <fmt/format.h>

#include <chrono>

#include "app/context/headless_context.h"
#include "renderer/measure/axes.h"

namespace si {
namespace {

std::vector<TunedFamily> families_of(const BiasSearch& search) {
    std::vector<TunedFamily> out;
    for (const BiasFound& f : search.tried())
        out.push_back({std::string(family_label(f.family)), bias_text(f.bias), f.bias, f.trial.acne(), f.trial.wrong(),
                       f.trial.lost(), f.trial.needs.gap_p95_m, f.trial.needs.shift_p95_m,
                       search.best() && search.best()->family == f.family});
    return out;
}

BiasSearchResult search(BiasSearchResult out, const Scene& scene, const TuningJob& job, const Workers& workers,
                        const std::function<void(const Tuner&)>& report) {
    const auto began = std::chrono::steady_clock::now();
    const HeadlessContext context;
    Renderer renderer;
    const Tuner tuner = run_tuning(renderer, scene, job, workers, report);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    out.found = tuner.result();
    out.families = families_of(tuner.bias());
    out.text = fmt::format("{}; {} trials in {:.1f} s", tuner.summary(), tuner.trials(), seconds);
    return out;
}

}  // namespace

bool BiasSearchResult::is_about(const Settings& now, int now_width, int now_height) const {
    Settings then = settings;
    if (found) apply_tuning(then, *found);
    then.bias = now.bias;
    then.truth.area = now.truth.area;  // a search sets its own
    return width == now_width && height == now_height && measured_settings(then) == measured_settings(now);
}

void EditorBiasSearch::start(const Scene& scene, const Settings& settings, int width, int height,
                             const TuneRequest& request) {
    TuningJob job{.settings = settings, .width = width, .height = height};
    job.settings.truth.area = request.area;
    job.goals.max_error = request.max_error;
    job.goals.max_ms = request.max_ms;
    job.goals.cost = request.cost;
    about_ = {};
    about_.scene = scene.id;
    about_.settings = job.settings;
    about_.width = width;
    about_.height = height;
    job_.start(
        [job, about = about_, copy = std::make_shared<const Scene>(scene)](const Workers& workers, const auto& report) {
            return search(about, *copy, job, workers, [&](const Tuner& tuner) {
                report({tuner.step_label(), tuner.progress()});
            });
        },
        {"the present bias", 0});
}

std::optional<BiasSearchResult> EditorBiasSearch::poll() {
    auto outcome = job_.poll();
    if (!outcome) return {};
    if (outcome->value) return std::move(outcome->value);
    BiasSearchResult none = about_;
    none.failed = !outcome->cancelled;
    none.text =
        outcome->cancelled ? "The search for the smallest bias was cancelled" : exception_message(outcome->problem);
    return none;
}

}  // namespace si
