// Long work on a thread of its own, so that who asks for it never waits.
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

/// What the exception says; empty for none.
inline std::string what_of(const std::exception_ptr& problem) {
    if (!problem) return {};
    try {
        std::rethrow_exception(problem);
    } catch (const std::exception& e) {
        return e.what();
    }
}

/// One work is wanted at a time, and one thread is at work: what is no longer wanted is cancelled, and the next starts
/// when it has ended. Nothing but wait() and the destructor blocks. All calls from one thread.
/// @tparam T what the work ends with @tparam Progress what is told while it goes on; a number is a share, 0..1
template <typename T, typename Progress = double>
class Job {
public:
    using Report = std::function<void(const Progress&)>;
    /// Hears of cancel() by its workers' token, which it answers by throwing; what else it throws is its problem. One
    /// thread is left to who asks. Work that draws makes an OpenGL context of its own.
    using Work = std::function<T(const Workers&, const Report&)>;

    /// What became of it.
    struct Outcome {
        std::optional<T> value;      ///< none: it failed or was cancelled
        std::exception_ptr problem;  ///< why it failed
        bool cancelled = false;
    };

    Job() = default;
    /// Cancels and joins.
    ~Job() { drop(); }
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    /// In place of what was wanted before, of which nothing more is heard. @throws std::system_error when there is no
    /// thread to be had
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
    /// Nothing is wanted any more: poll() will say that it was cancelled, also when it had just ended.
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
    /// As cancel(), and nothing more is heard of it.
    void drop() {
        const std::lock_guard lock(shared_->mutex);
        shared_->stop.request_stop();
        shared_->stop = {};  // what is under way is not the one that is heard of
        shared_->next = nullptr;
        shared_->outcome.reset();
        shared_->wanted = shared_->moved = false;
    }

    /// Something was started that was neither cancelled nor polled.
    bool wanted() const {
        const std::lock_guard lock(shared_->mutex);
        return shared_->wanted;
    }
    /// A thread is at work, wanted or not, or its outcome was not polled.
    bool busy() const {
        const std::lock_guard lock(shared_->mutex);
        return shared_->working || shared_->outcome;
    }
    /// poll() has something.
    bool ended() const {
        const std::lock_guard lock(shared_->mutex);
        return shared_->outcome.has_value();
    }
    /// The progress differs from that last asked for, or poll() has something.
    bool moved() const {
        const std::lock_guard lock(shared_->mutex);
        return shared_->moved || shared_->outcome;
    }
    /// Of what is wanted.
    std::optional<Progress> progress() const {
        const std::lock_guard lock(shared_->mutex);
        shared_->moved = false;
        return shared_->wanted ? std::optional(shared_->progress) : std::nullopt;
    }
    /// What became of it, once.
    std::optional<Outcome> poll() {
        const std::lock_guard lock(shared_->mutex);
        if (!shared_->outcome) return {};
        shared_->wanted = shared_->moved = false;
        return std::exchange(shared_->outcome, std::nullopt);
    }
    /// Until ended(), or nothing is at work.
    void wait() const {
        std::unique_lock lock(shared_->mutex);
        shared_->changed.wait(lock, [&] { return !shared_->working || shared_->outcome; });
    }

private:
    struct Shared {
        std::mutex mutex;
        std::condition_variable changed;
        Work next;              ///< to begin when what is under way has ended
        std::stop_source stop;  ///< of what was started last
        Progress progress{};
        std::optional<Outcome> outcome;
        bool working = false, wanted = false, moved = false;
    };

    /// Whether a change of the progress is worth telling.
    static bool tells(const Progress& before, const Progress& now) {
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
            shared.moved |= tells(shared.progress, progress);
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
    std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace si
