// How far a frame is while it is drawn: for whoever waits for it in another thread.
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

namespace si {

/// Written by the thread that draws, read by any.
class PassProgress {
public:
    struct State {
        std::string pass;              ///< begun last; empty: none yet
        std::size_t done = 0, of = 0;  ///< passes
        bool operator==(const State&) const = default;
    };
    State state() const {
        const std::lock_guard lock(mutex_);
        return state_;
    }
    void set(std::string_view pass, std::size_t done, std::size_t of) {
        const std::lock_guard lock(mutex_);
        state_ = {std::string(pass), done, of};
    }

private:
    mutable std::mutex mutex_;
    State state_;
};

/// While it lives, frames drawn on its thread tell how far they are.
class PassProgressScope {
public:
    explicit PassProgressScope(PassProgress& progress) { current() = &progress; }
    ~PassProgressScope() { current() = nullptr; }
    PassProgressScope(const PassProgressScope&) = delete;
    PassProgressScope& operator=(const PassProgressScope&) = delete;
    /// Of this thread; null: nobody watches.
    static PassProgress*& current() {
        thread_local PassProgress* watched = nullptr;
        return watched;
    }
};

}  // namespace si
