#include "app/session/scene_loading.h"

#include <atomic>
#include <chrono>
#include <future>
#include <utility>

#include "app/session/session.h"
#include "renderer/scenes/builtin.h"

namespace si {

struct SceneLoading::Job {
    std::string name;
    int file_scene = -1;
    std::atomic<bool> cancelled{false};
    std::atomic<double> progress{0};
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    std::future<Scene> scene;  ///< last: its destructor joins the thread, which uses the others
};

SceneLoading::SceneLoading(SceneReader read) : read_(std::move(read)) {
    if (!read_) read_ = [](const std::string& name, const GltfOptions& options) { return load_scene(name, options); };
}

SceneLoading::~SceneLoading() {
    cancel();
}

void SceneLoading::launch(const Wish& wish) {
    auto job = std::make_unique<Job>();
    job->name = wish.name;
    job->file_scene = wish.file_scene;
    job->scene = std::async(std::launch::async, [&state = *job, read = read_] {
        GltfOptions options;
        options.scene = state.file_scene;
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

void SceneLoading::start(const std::string& name_or_path, int file_scene) {
    cancel();
    const Wish wish{name_or_path, file_scene};
    if (job_)
        next_ = wish;
    else
        launch(wish);
}

void SceneLoading::cancel() {
    next_.reset();
    if (job_) job_->cancelled = true;
}

std::string SceneLoading::wanted() const {
    if (next_) return next_->name;
    return job_ && !job_->cancelled ? job_->name : std::string();
}

double SceneLoading::progress() const {
    return job_ && !job_->cancelled ? job_->progress.load() : 0;
}

double SceneLoading::seconds_left() const {
    if (!job_ || job_->cancelled) return 0;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - job_->start;
    return remaining_seconds(passed.count(), job_->progress);
}

double remaining_seconds(double passed, double progress) {
    constexpr double kLeastSeconds = 1, kLeastProgress = 0.05;
    if (passed < kLeastSeconds || progress < kLeastProgress || progress >= 1) return 0;
    return passed / progress * (1 - progress);
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
        const Wish wish = *std::exchange(next_, {});
        outcome.name = wish.name;
        launch(wish);
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
