#include "app/editor/truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <thread>

#include "app/base/output.h"
#include "app/report/measure_json.h"
#include "app/report/report.h"
#include "renderer/base/error.h"
#include "renderer/reference/error_task.h"

namespace si {
namespace {

/// All but one thread, which draws.
int tracing_threads() {
    return std::max(1, int(std::thread::hardware_concurrency()) - 1);
}

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

struct EditorTruth::Outcome {
    std::shared_ptr<const TruthPicture> picture;  ///< null: as it was
    std::string remark;
};

struct EditorTruth::Job {
    const char* doing = "";
    std::uint64_t key = 0;  ///< of the truth it works on
    std::stop_source stop;
    std::atomic<double> progress{0};
    std::future<Outcome> outcome;  ///< last: its destructor joins the thread, which uses the others

    Workers workers() {
        return {.threads = tracing_threads(), .stop = stop.get_token(), .progress = [this](double t) { progress = t; }};
    }
};

EditorTruth::EditorTruth() = default;

EditorTruth::~EditorTruth() {
    if (job_) job_->stop.request_stop();
}

template <typename Work>
void EditorTruth::launch(const char* doing, std::uint64_t key, Work&& work) {
    auto job = std::make_unique<Job>();
    job->doing = doing;
    job->key = key;
    job->outcome = std::async(std::launch::async,
                              [&state = *job, work = std::forward<Work>(work)] { return work(state.workers()); });
    job_ = std::move(job);
}

bool EditorTruth::moved() const {
    if (!job_) return false;
    return job_->outcome.wait_for(std::chrono::seconds(0)) == std::future_status::ready ||
           int(job_->progress * 100) != shown_percent_;
}

void EditorTruth::wait() const {
    if (job_) job_->outcome.wait();
}

void EditorTruth::clear() {
    if (job_) job_->stop.request_stop();
    picture_.reset();
}

bool EditorTruth::poll() {
    if (!job_ || job_->outcome.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    const std::unique_ptr<Job> job = std::move(job_);
    try {
        Outcome outcome = job->outcome.get();
        if (outcome.picture) picture_ = std::move(outcome.picture), problem_.clear(), given_up_ = 0;
        remark_ = std::move(outcome.remark);
    } catch (const Cancelled&) {
    } catch (const std::exception& e) {
        given_up_ = job->key;
        problem_ = e.what();
        throw;
    }
    return true;
}

void EditorTruth::start_trace(Renderer& renderer, const Scene& scene, const Settings& settings,
                              const FrameRequest& request) {
    auto task = std::make_shared<TruthTask>(truth_task(renderer, scene, settings, request, settings.view.light,
                                                       truth_options(settings), cache_.geometry()));
    const std::uint64_t key = task->key;
    launch("Tracing rays", key, [this, task = std::move(task)](const Workers& workers) {
        return Outcome{truth_picture(*task, cache_.trace(*task, workers)), {}};
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
    launch("Measuring", request.truth->key, [path, measured = std::move(measured)](const Workers&) {
        sum_up(*measured);
        write_file(path, json_text(saved_error(*measured)));
        return Outcome{nullptr, "Saved " + path};
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
        if (job_) job_->stop.request_stop();
    }
    if (job_) {
        const bool stale = need.key != 0 && job_->key != need.key;
        const bool unwanted = need.key == 0 && !save_next_;
        if (stale || unwanted) job_->stop.request_stop();
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
    if (job_) {
        f.doing = job_->doing;
        f.progress = job_->progress;
    }
    shown_percent_ = job_ ? int(f.progress * 100) : -1;
    if (picture_) {
        const TracedTruth& t = picture_->traced;
        f.build_ms = t.build_ms, f.place_ms = t.place_ms, f.trace_ms = t.trace_ms;
        f.rays = t.truth->rays, f.noise = noise_text(*t.truth);
        f.width = t.truth->width, f.height = t.truth->height;
    }
    return f;
}

}  // namespace si
