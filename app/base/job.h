// Long work on a background thread, polled by the thread that started it.
//
//     Job<Scene> job;
//     job.start([](const Workers& workers, const auto& report) { return read(workers.stop, report); });
//     if (auto outcome = job.poll(); outcome && outcome->value) show(*outcome->value);   // now and then
#pragma once

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>

#include "renderer/base/workers.h"

namespace si {

/// Returns the message of an exception; empty for a null pointer.
inline std::string exception_message(const std::exception_ptr& problem) {
    if (!problem) return {};
    try {
        std::rethrow_exception(problem);
    } catch (const std::exception& e) {
        return e.what();
    }
}

/// Background job: runs one piece of work at a time on a thread of its own. Newly started work cancels the present
/// work, and begins once the cancelled work has ended. Only wait() and the destructor block. Make all calls from one
/// thread.
/// @tparam T result of the work @tparam Progress type of progress reports; a number is the share done, 0..1
template <typename T, typename Progress = double>
class Job {
public:
    using Report = std::function<void(const Progress&)>;
    /// Function that does the work. It checks its workers' stop token and throws Cancelled after cancel(); any other
    /// exception becomes Outcome::problem. Its workers leave one CPU thread free. Work that draws makes an OpenGL
    /// context of its own.
    using Work = std::function<T(const Workers&, const Report&)>;

    /// Outcome of a background job that has ended: the value that the work returned, its exception, or its
    /// cancellation.
    struct Outcome {
        std::optional<T> value;      ///< result of the work; none: the work failed or was cancelled
        std::exception_ptr problem;  ///< exception that the work threw
        bool cancelled = false;
    };

    /// Cancels the background work and joins its thread.
    ~Job() { drop(); }

    /// Starts background work; earlier work is cancelled and its outcome dropped. @param first progress until the work
    /// reports some
    /// @throws std::system_error if the system cannot start another thread
    void start(Work work, Progress first = {}) {
        bool launch = false;
        {
            const std::lock_guard lock(shared_->mutex);
            shared_->stop.request_stop();
            shared_->stop = {};
            shared_->next = std::move(work);
            shared_->outcome.reset();
            shared_->progress = std::move(first);
            shared_->wanted = shared_->moved = true;
            launch = !std::exchange(shared_->working, true);
        }
        if (!launch) return;
        try {
            thread_ = std::jthread([shared = shared_] { run(*shared); });  // joins one that has nothing more to do
        } catch (...) {
            const std::lock_guard lock(shared_->mutex);
            shared_->next = nullptr;
            shared_->wanted = shared_->working = false;
            throw;
        }
    }
    /// Cancels the background work. poll() then reports it as cancelled, even if it had just ended.
    void cancel() {
        const std::lock_guard lock(shared_->mutex);
        if (!shared_->wanted) return;
        shared_->wanted = false;
        shared_->stop.request_stop();
        if (!shared_->next && !shared_->outcome) return;
        shared_->next = nullptr;  // before it began
        shared_->outcome = Outcome{.value = {}, .problem = {}, .cancelled = true};
        shared_->changed.notify_all();
    }
    /// Cancels the background work and drops its outcome: poll() reports nothing.
    void drop() {
        const std::lock_guard lock(shared_->mutex);
        shared_->stop.request_stop();
        shared_->stop = {};  // the running work keeps the old source, so that its outcome is dropped
        shared_->next = nullptr;
        shared_->outcome.reset();
        shared_->wanted = shared_->moved = false;
    }

    /// Returns true from start() until the background work is cancelled or its outcome polled.
    bool wanted() const {
        const std::lock_guard lock(shared_->mutex);
        return shared_->wanted;
    }
    /// Returns true while the background thread runs (also for cancelled work) or the outcome of its work waits for
    /// poll().
    bool busy() const {
        const std::lock_guard lock(shared_->mutex);
        return shared_->working || shared_->outcome;
    }
    /// Returns true if poll() would return the outcome of background work.
    bool ended() const {
        const std::lock_guard lock(shared_->mutex);
        return shared_->outcome.has_value();
    }
    /// Returns true if the progress of the background work changed since the last call of progress(), or its outcome
    /// waits for poll().
    bool has_news() const {
        const std::lock_guard lock(shared_->mutex);
        return shared_->moved || shared_->outcome;
    }
    /// Returns the latest progress report of the present background work; nothing without work.
    std::optional<Progress> progress() const {
        const std::lock_guard lock(shared_->mutex);
        shared_->moved = false;
        return shared_->wanted ? std::optional(shared_->progress) : std::nullopt;
    }
    /// Returns the outcome of the background work and forgets it; nothing while the work runs.
    std::optional<Outcome> poll() {
        const std::lock_guard lock(shared_->mutex);
        if (!shared_->outcome) return {};
        shared_->wanted = shared_->moved = false;
        return std::exchange(shared_->outcome, std::nullopt);
    }
    /// Blocks until the background work has ended.
    void wait() const {
        std::unique_lock lock(shared_->mutex);
        shared_->changed.wait(lock, [&] { return !shared_->working || shared_->outcome; });
    }

private:
    /// State that a background job (Job) and its thread share. The mutex guards all members.
    struct Shared {
        std::mutex mutex;
        std::condition_variable changed;
        Work next;              ///< work that begins when the present work has ended
        std::stop_source stop;  ///< stops the work that was started last
        Progress progress{};
        std::optional<Outcome> outcome;
        bool working = false, wanted = false, moved = false;
    };

    /// Returns true if two progress reports differ visibly: numbers in whole percent, reports of other types always.
    static bool differs_visibly(const Progress& before, const Progress& now) {
        if constexpr (std::is_arithmetic_v<Progress>)
            return int(before * 100) != int(now * 100);
        else
            return true;
    }

    static void run(Shared& shared) {
        std::unique_lock lock(shared.mutex);
        while (shared.next) {
            Work work = std::exchange(shared.next, nullptr);
            const std::stop_source stop = shared.stop;
            lock.unlock();
            Outcome outcome = outcome_of(shared, std::move(work), stop);
            lock.lock();
            if (!(stop == shared.stop)) continue;
            shared.outcome = std::move(outcome);
            shared.changed.notify_all();
        }
        shared.working = false;
        shared.changed.notify_all();
    }

    static Outcome outcome_of(Shared& shared, Work work, const std::stop_source& stop) {
        const Report report = [&](const Progress& progress) {
            const std::lock_guard lock(shared.mutex);
            if (!(stop == shared.stop)) return;
            shared.moved |= differs_visibly(shared.progress, progress);
            shared.progress = progress;
        };
        Workers workers{.threads = std::max(1, Workers{}.count() - 1), .stop = stop.get_token()};
        if constexpr (std::is_same_v<Progress, double>) workers.progress = report;
        Outcome outcome;
        try {
            outcome.value = work(workers, report);
        } catch (const Cancelled&) {
            outcome.cancelled = true;
        } catch (...) {
            outcome.problem = std::current_exception();
        }
        if (stop.stop_requested()) outcome = {.value = {}, .problem = {}, .cancelled = true};
        return outcome;
    }

    std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
    std::jthread thread_;  ///< declared last, so that its thread ends first
};

}  // namespace si
