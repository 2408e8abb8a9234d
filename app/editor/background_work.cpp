#include "app/editor/background_work.h"

#include <algorithm>

#include "app/editor/requests.h"
#include "renderer/inspect/pixel_diagnosis.h"

namespace si {

bool BackgroundWork::poll_found(auto& search) {
    std::string problem;
    if (!search.poll(problem)) return false;
    if (!problem.empty()) state_.log.add(LogKind::Warning, problem);
    return true;
}

bool BackgroundWork::poll(const Scene* scene) {
    const bool tuned = poll_tuning(scene);
    const bool cured = poll_found(fixes_);
    const bool advised = poll_found(advice_);
    const bool compared = poll_found(pipelines_);
    const bool shimmered = poll_found(shimmer_);
    return poll_found(optimisation_times_) || shimmered || compared || advised || cured || tuned;
}

bool BackgroundWork::fulfil_optimisation_times(const SceneLoader& scenes, const FrameRequest& request,
                                               const EditorRequests& requests) {
    if (requests.cancel_measuring) optimisation_times_.cancel();
    if (!requests.measure_saved_times) return requests.cancel_measuring;
    return attempt(state_, [&] { optimisation_times_.start(scenes.require(), state_.settings, request); });
}

bool BackgroundWork::poll_tuning(const Scene* scene) {
    const auto outcome = bias_search_.poll();
    if (!outcome) return false;
    if (!outcome->families.empty()) tuning_ = *outcome;
    if (!outcome->found) {
        if (outcome->failed)
            report(state_, outcome->text);
        else
            state_.log.add(LogKind::Info, outcome->text);
        return true;
    }
    // The result is valid for its scene, camera and light only.
    Settings now = state_.settings;
    apply_tuning(now, outcome->settings);
    now.view = outcome->settings.view;
    if (!scene || scene->id != outcome->scene || !(now == outcome->settings)) {
        state_.log.add(LogKind::Warning, "Not applied, as scene or settings changed meanwhile: " + outcome->text);
        return true;
    }
    apply_tuning(state_.settings, *outcome->found);
    state_.log.add(LogKind::Info, outcome->text);
    return true;
}

void BackgroundWork::start_fixes(const Scene& scene, glm::ivec2 size, std::span<const PixelDiagnosis> diagnoses,
                                 const FixRequest& request) {
    std::vector<FixCandidate> own;
    const auto light = std::size_t(std::max(state_.settings.view.light, 0));
    if (request.pixel && light < diagnoses.size() && diagnoses[light].fix)
        own.push_back(suggested_candidate(*diagnoses[light].fix, state_.settings));
    fixes_.start(scene, state_.settings, size.x, size.y, request.pixel, std::move(own));
}

void BackgroundWork::apply_sweep_base() {
    if (!sweep_.base()) return;
    const ViewSettings view = state_.settings.view;
    const int light = sweep_.base()->view.light;
    state_.settings = *sweep_.base();
    state_.settings.view = view;
    state_.settings.view.light = light;
}

bool BackgroundWork::fulfil(const SceneLoader& scenes, glm::ivec2 size, std::span<const PixelDiagnosis> diagnoses,
                            const EditorRequests& requests) {
    bool changed = false;
    const auto request = [&](bool requested, const auto& what) {
        if (requested) changed |= attempt(state_, what);
    };
    // A measurement needs a size, which a hidden picture does not have.
    request(requests.tune.has_value(),
            [&] { bias_search_.start(scenes.require(), state_.settings, size.x, size.y, *requests.tune); });
    if (requests.cancel_tune) bias_search_.cancel();
    request(requests.find_fixes.has_value(),
            [&] { start_fixes(scenes.require(), size, diagnoses, *requests.find_fixes); });
    if (requests.cancel_fixes) fixes_.cancel();
    request(requests.forget_fixes, [&] { fixes_.forget(); });
    request(requests.find_advice.has_value(),
            [&] { advice_.start(scenes.require(), state_.settings, size.x, size.y, *requests.find_advice); });
    if (requests.cancel_advice) advice_.cancel();
    const auto present = [&] { return LabSubject{scenes.require().id, state_.settings, size.x, size.y}; };
    request(requests.compare_pipelines, [&] { pipelines_.start(scenes.require(), present()); });
    if (requests.cancel_pipelines) pipelines_.cancel();
    request(requests.measure_shimmer.has_value(),
            [&] { shimmer_.start(scenes.require(), present(), *requests.measure_shimmer); });
    if (requests.cancel_shimmer) shimmer_.cancel();
    request(requests.start_sweep.has_value(),
            [&] { sweep_.start(scenes.require(), state_.scene_name, state_.settings, *requests.start_sweep); });
    request(requests.cancel_sweep, [&] { sweep_.cancel(); });
    request(requests.open_sweep.has_value(), [&] { open_sweep(*requests.open_sweep); });
    request(requests.save_sweep.has_value(), [&] {
        sweep_.save(*requests.save_sweep);
        state_.log.add(LogKind::Info, "Saved " + *requests.save_sweep + "/report.html and its tables");
    });
    request(requests.apply_sweep_base, [&] { apply_sweep_base(); });
    return changed;
}

bool BackgroundWork::update(const Scene* scene, const EditorRequests& requests) {
    if (requests.want_present && scene)
        sweep_.measure_present(*scene, state_.scene_name, state_.settings, state_.sweep);
    else
        sweep_.stop_measuring_present();
    const bool had_problem = !sweep_.facts().problem.empty();
    const bool changed = sweep_.update(state_);
    if (!had_problem && !sweep_.facts().problem.empty()) report(state_, "The sweep ended: " + sweep_.facts().problem);
    return changed;
}

void BackgroundWork::fill(EditorFrame& f, const Scene* scene, glm::ivec2 size) const {
    f.tuning = bias_search_.facts();
    if (scene && tuning_ && tuning_->scene == scene->id) {
        f.tuned = tuning_->families;
        f.tuned_current = tuning_->is_about(state_.settings, size.x, size.y);
    }
    f.fixes = fixes_.facts(scene ? scene->id : 0, state_.settings, size.x, size.y);
    optimisation_times_.fill(f, scene ? scene->id : 0, state_.settings, size.x, size.y);
    advice_.fill(f, scene ? scene->id : 0, state_.settings, size.x, size.y);
    const LabSubject present{scene ? scene->id : 0, state_.settings, size.x, size.y};
    pipelines_.fill(f, present);
    shimmer_.fill(f, present);
    f.sweep = &sweep_.facts();
}

}  // namespace si
