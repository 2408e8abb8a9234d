#include "app/editor/advice.h"

#include "app/context/headless_context.h"

namespace si {

void EditorAdvice::start(const Scene& scene, const Settings& settings, int width, int height,
                         const AdviceRequest& request) {
    found_.reset();
    const AdviceFound about{{}, {}, scene.id, settings, width, height};
    job_.start(
        [copy = std::make_shared<const Scene>(scene), about, request](const Workers& workers, const auto& report) {
            AdviceFound out = about;
            const HeadlessContext context;
            Renderer renderer;
            ReferenceCache cache;
            const auto report_progress = [&](double share, const std::string& what) { report({what, share}); };
            if (!request.max_error && !request.max_ms) {
                out.what = find_advice(renderer, *copy, out.settings, out.width, out.height, {.cost = request.cost},
                                       cache, workers, report_progress);
                return out;
            }
            const AutopilotGoals goals{.max_error = request.max_error, .max_ms = request.max_ms, .cost = request.cost};
            AutopilotResult flight = run_rendered_autopilot(renderer, *copy, out.settings, out.width, out.height, goals,
                                                            {}, cache, workers, report_progress);
            out.changes = setting_changes(measured_settings(out.settings), flight.best.settings);
            out.what = std::move(flight);
            return out;
        },
        {"the present settings", 0});
}

void EditorAdvice::fill(AdvicePanelFacts& shown, std::uint64_t scene, const Settings& settings, int width,
                        int height) const {
    shown.advising = job_.progress();
    if (!found_ || found_->scene != scene) return;
    shown.advice = std::get_if<AdviceReport>(&found_->what);
    shown.autopilot = std::get_if<AutopilotResult>(&found_->what);
    shown.autopilot_changes = found_->changes;
    shown.advice_current = found_->width == width && found_->height == height &&
                           measured_settings(found_->settings) == measured_settings(settings);
}

}  // namespace si
