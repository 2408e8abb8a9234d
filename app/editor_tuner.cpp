#include "app/editor_tuner.h"

#include <fmt/format.h>

#include <chrono>

#include "app/headless_context.h"

namespace si {
namespace {

EditorTuner::Outcome search(const std::shared_ptr<const Scene>& scene, const TuningJob& job, const Workers& workers,
                            const std::function<void(const Tuner&)>& report) {
    EditorTuner::Outcome out{.scene = scene->id, .settings = job.settings};
    try {
        const auto began = std::chrono::steady_clock::now();
        const HeadlessContext context;
        Renderer renderer;
        const Tuner tuner = run_tuning(renderer, *scene, job, workers, report);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
        out.found = tuner.result();
        out.text = fmt::format("{}; {} trials in {:.1f} s", tuner.summary(), tuner.trials(), seconds);
    } catch (const Cancelled&) {
        out.text = "The search for the least bias was cancelled";
    } catch (const std::exception& e) {
        out.text = e.what();
        out.failed = true;
    }
    return out;
}

}  // namespace

void EditorTuner::start(const Scene& scene, const Settings& settings, int width, int height, const TuneWish& wish) {
    cancel();
    if (thread_.joinable()) thread_.join();
    TuningJob job{.settings = settings, .width = width, .height = height};
    job.settings.truth.area = wish.area;
    job.goals.most_error = wish.most_error, job.goals.most_ms = wish.most_ms;
    shared_ = std::make_shared<Shared>();
    thread_ = std::jthread([job, copy = std::make_shared<const Scene>(scene), shared = shared_](std::stop_token stop) {
        // One thread is left to the editor.
        const Workers workers{.threads = std::max(1, Workers{}.count() - 1), .stop = stop};
        Outcome outcome = search(copy, job, workers, [&](const Tuner& tuner) {
            const std::lock_guard lock(shared->mutex);
            shared->facts = {tuner.about(), tuner.progress()};
            shared->moved = true;
        });
        const std::lock_guard lock(shared->mutex);
        shared->outcome = std::move(outcome);
        shared->moved = true;
    });
}

void EditorTuner::cancel() {
    thread_.request_stop();
}

bool EditorTuner::moved() const {
    if (!running()) return false;
    const std::lock_guard lock(shared_->mutex);
    return shared_->moved;
}

std::optional<TuneFacts> EditorTuner::facts() const {
    if (!running()) return {};
    const std::lock_guard lock(shared_->mutex);
    shared_->moved = shared_->outcome.has_value();
    return shared_->facts;
}

std::optional<EditorTuner::Outcome> EditorTuner::end() {
    if (!running()) return {};
    {
        const std::lock_guard lock(shared_->mutex);
        if (!shared_->outcome) return {};
    }
    thread_.join();
    return std::move(shared_->outcome);
}

void EditorTuner::wait() const {
    while (running()) {
        {
            const std::lock_guard lock(shared_->mutex);
            if (shared_->outcome) return;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

}  // namespace si
