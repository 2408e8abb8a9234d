// Long work on a thread with an OpenGL context of its own, so that the editor never waits for it.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "renderer/reference/workers.h"

namespace si {

/// @tparam Facts what the editor is told while it runs @tparam Outcome what it ends with
/// All calls from one thread.
template <typename Facts, typename Outcome>
class ContextJob {
public:
    using Report = std::function<void(const Facts&)>;
    using Work = std::function<Outcome(const Workers&, const Report&)>;

    /// In place of what is under way. `work` makes its own context, catches what it throws, and hears of cancel() by
    /// its workers' token; one thread is left to the editor.
    void start(const Facts& first, Work work) {
        cancel();
        if (thread_.joinable()) thread_.join();
        shared_ = std::make_shared<Shared>();
        shared_->facts = first;
        thread_ = std::jthread([work = std::move(work), shared = shared_](std::stop_token stop) {
            const Workers workers{.threads = std::max(1, Workers{}.count() - 1), .stop = stop};
            Outcome outcome = work(workers, [&](const Facts& facts) {
                const std::lock_guard lock(shared->mutex);
                shared->facts = facts;
                shared->moved = true;
            });
            const std::lock_guard lock(shared->mutex);
            shared->outcome = std::move(outcome);
            shared->moved = true;
        });
    }
    void cancel() { thread_.request_stop(); }
    bool running() const { return thread_.joinable(); }
    /// facts() differ from those last asked for, or end() has something.
    bool moved() const {
        if (!running()) return false;
        const std::lock_guard lock(shared_->mutex);
        return shared_->moved;
    }
    /// Nothing unless it runs.
    std::optional<Facts> facts() const {
        if (!running()) return {};
        const std::lock_guard lock(shared_->mutex);
        shared_->moved = shared_->outcome.has_value();
        return shared_->facts;
    }
    /// What became of it, once; joins its thread.
    std::optional<Outcome> end() {
        if (!running()) return {};
        {
            const std::lock_guard lock(shared_->mutex);
            if (!shared_->outcome) return {};
        }
        thread_.join();
        return std::move(shared_->outcome);
    }
    void wait() const {
        while (running()) {
            {
                const std::lock_guard lock(shared_->mutex);
                if (shared_->outcome) return;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    }

private:
    struct Shared {
        std::mutex mutex;
        Facts facts;
        std::optional<Outcome> outcome;
        bool moved = true;
    };
    std::shared_ptr<Shared> shared_;
    std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace si
