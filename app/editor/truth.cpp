#include "app/editor/truth.h"

#include <fmt/format.h>

#include <utility>

#include "app/base/output.h"
#include "app/report/measure_json.h"
#include "app/report/report.h"
#include "renderer/base/error.h"
#include "renderer/reference/error_task.h"

namespace si {
namespace {

nlohmann::ordered_json saved_error(const MeasuredError& measured) {
    const Truth& truth = *measured.traced.truth;
    nlohmann::ordered_json json = {{"format", "shadow-inspector-measurement"},
                                   {"version", 1},
                                   {"light", measured.light},
                                   {"width", measured.picture.x},
                                   {"height", measured.picture.y},
                                   {"map_resolution", measured.map_resolution},
                                   {"area", truth.is_area()},
                                   {"step", truth.step},
                                   {"truth_noise", truth.noise}};
    json["truth"] = truth_quality_json(truth);
    json["error"] = error_json(measured.metrics);
    return json;
}

}  // namespace

void EditorTruth::clear() {
    job_.drop();
    picture_.reset();
}

bool EditorTruth::poll() {
    auto outcome = job_.poll();
    if (!outcome) return false;
    if (outcome->value) {
        if (outcome->value->picture) picture_ = std::move(outcome->value->picture), problem_.clear(), given_up_ = 0;
        remark_ = std::move(outcome->value->remark);
    }
    if (outcome->problem) try {
            std::rethrow_exception(outcome->problem);
        } catch (const std::exception& e) {
            given_up_ = doing_key_;
            problem_ = e.what();
            throw;
        }
    return true;
}

void EditorTruth::start_trace(Renderer& renderer, const Scene& scene, const Settings& settings,
                              const FrameRequest& request) {
    auto task = std::make_shared<TruthTask>(
        truth_task(renderer, scene, settings, request, settings.view.light, truth_options(settings)));
    doing_ = "Tracing rays", doing_key_ = task->key;
    job_.start([this, task = std::move(task)](const Workers& workers, const auto&) {
        return Found{truth_picture(*task, cache_.trace(*task, workers)), {}};
    });
}

void EditorTruth::start_save(Renderer& renderer, const Scene& scene, const Settings& settings,
                             const FrameRequest& request, const std::string& path) {
    require_writable(path);
    FrameRequest judged = request;
    judged.outputs = {.colour = false, .judged = true};
    judged.timing = judged.force = false;
    const FrameResult frame = renderer.render(scene, settings, judged);
    auto measured = std::make_shared<MeasuredError>(read_judged(renderer, frame, *request.truth, settings.view.light));
    doing_ = "Measuring", doing_key_ = request.truth->key;
    job_.start([path, measured = std::move(measured)](const Workers&, const auto&) {
        sum_up(*measured);
        write_file(path, json_text(saved_error(*measured)));
        return Found{nullptr, "Saved " + path};
    });
}

bool EditorTruth::update(Renderer& renderer, const Scene& scene, const Settings& settings, const FrameRequest& request,
                         const FrameResult& frame, bool drawn, const Wishes& wishes) {
    const bool changed = poll();
    const TruthNeed& need = frame.truth;
    if (wishes.save_error) save_next_ = wishes.save_error;
    if (need.key != given_up_ && need.key != 0) given_up_ = 0, problem_.clear();
    if (wishes.cancel) {
        given_up_ = need.key;
        problem_ = "Cancelled";
        job_.cancel();
    }
    if (job_.busy()) {
        const bool stale = need.key != 0 && doing_key_ != need.key;
        const bool unwanted = need.key == 0 && !save_next_;
        if (stale || unwanted) job_.cancel();
        return changed;
    }
    // A picture that was found just now is drawn before it is judged what is missing.
    if (drawn || changed || (picture_ && request.truth != picture_)) return changed;
    if (save_next_ && need.met) {
        start_save(renderer, scene, settings, request, *std::exchange(save_next_, {}));
    } else if (need.key != 0 && !need.met && need.key != given_up_) {
        start_trace(renderer, scene, settings, request);
    } else if (save_next_) {
        remark_ = "Not saved: the truth about this view is not traced";
        save_next_.reset();
    } else {
        return changed;
    }
    return true;
}

TruthFacts EditorTruth::facts(const FrameResult& frame) const {
    TruthFacts f;
    f.wanted = frame.truth.key != 0;
    f.current = frame.truth.met;
    f.problem = problem_;
    if (job_.busy()) f.doing = doing_;
    f.progress = job_.progress().value_or(0);
    if (picture_) {
        const TracedTruth& t = picture_->traced;
        f.build_ms = t.build_ms, f.place_ms = t.place_ms, f.trace_ms = t.trace_ms;
        f.rays = t.truth->rays, f.noise = noise_text(*t.truth);
        f.width = t.truth->width, f.height = t.truth->height;
    }
    return f;
}

}  // namespace si
