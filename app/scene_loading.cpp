#include "app/scene_loading.h"

#include <atomic>
#include <chrono>
#include <future>
#include <utility>

#include "app/session.h"
#include "renderer/scenes/builtin.h"

namespace si {

struct SceneLoading::Job {
    std::string name;
    std::atomic<bool> cancelled{false};
    std::atomic<double> progress{0};
    std::future<Scene> scene;  ///< last: its destructor joins the thread, which uses the others
};

SceneLoading::SceneLoading(SceneReader read) : read_(std::move(read)) {
    if (!read_) read_ = [](const std::string& name, const GltfOptions& options) { return load_scene(name, options); };
}

SceneLoading::~SceneLoading() {
    cancel();
}

void SceneLoading::launch(const std::string& name_or_path) {
    auto job = std::make_unique<Job>();
    job->name = name_or_path;
    job->scene = std::async(std::launch::async, [&state = *job, read = read_] {
        GltfOptions options;
        options.progress = [&state](double fraction) {
            state.progress = fraction;
            return !state.cancelled;
        };
        Scene scene = read(state.name, options);
        pose_scene(scene, {});
        return scene;
    });
    job_ = std::move(job);
}

void SceneLoading::start(const std::string& name_or_path) {
    cancel();
    if (job_)
        next_ = name_or_path;
    else
        launch(name_or_path);
}

void SceneLoading::cancel() {
    next_.reset();
    if (job_) job_->cancelled = true;
}

std::string SceneLoading::wanted() const {
    if (next_) return *next_;
    return job_ && !job_->cancelled ? job_->name : std::string();
}

double SceneLoading::progress() const {
    return job_ && !job_->cancelled ? job_->progress.load() : 0;
}

bool SceneLoading::ended() const {
    return job_ && job_->scene.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::optional<SceneLoading::Outcome> SceneLoading::poll() {
    if (!ended()) return {};
    const std::unique_ptr<Job> job = std::move(job_);
    Outcome outcome{.name = job->name, .scene = {}, .error = {}};
    try {
        if (!job->cancelled) {
            outcome.scene = job->scene.get();
            return outcome;
        }
        if (!next_) return {};
        outcome.name = *std::exchange(next_, {});
        launch(outcome.name);
        return {};
    } catch (const std::exception& e) {
        outcome.error = e.what();
        return outcome;
    }
}

void SceneLoading::wait() const {
    if (job_) job_->scene.wait();
}

}  // namespace si
