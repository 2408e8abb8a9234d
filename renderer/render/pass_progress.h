// Progress of a frame while it is drawn, for other threads that wait for it.
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

namespace si {

/// Progress of drawing one frame: current pass and number of finished ones. The drawing thread writes it, any thread
/// reads it.
class PassProgress {
public:
    /// Copy of the progress of one frame: current pass, finished passes and their total.
    struct State {
        std::string pass;              ///< pass begun last; empty: none yet
        std::size_t done = 0, of = 0;  ///< finished passes; all passes
        bool operator==(const State&) const = default;
    };
    /// Returns the current progress; safe in any thread.
    State state() const {
        const std::lock_guard lock{mutex_};
        return state_;
    }
    /// Sets the current pass, the finished passes and their total.
    void set(std::string_view pass, std::size_t done, std::size_t of) {
        const std::lock_guard lock{mutex_};
        state_ = {std::string(pass), done, of};
    }

private:
    mutable std::mutex mutex_;
    State state_;
};

/// Scope in which frames drawn on this thread report their progress to a PassProgress, from construction to
/// destruction.
class PassProgressScope {
public:
    explicit PassProgressScope(PassProgress& progress) { current() = &progress; }
    ~PassProgressScope() { current() = nullptr; }
    PassProgressScope(const PassProgressScope&) = delete;
    PassProgressScope& operator=(const PassProgressScope&) = delete;
    /// Returns the progress object of this thread; null outside any scope.
    static PassProgress*& current() {
        thread_local PassProgress* watched = nullptr;
        return watched;
    }
};

}  // namespace si
