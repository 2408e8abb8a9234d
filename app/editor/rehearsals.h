// Makes the programs of a frame that is likely to be asked for, on a thread with an OpenGL context of its own while
// nothing else happens. What one context of a driver has made, another finds in the driver's cache of shaders; where
// there is none, nothing is gained.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

#include "renderer/frame/renderer.h"

namespace si {

/// A frame whose programs are wanted, those for probed pixels too.
struct Warmup {
    std::shared_ptr<const Scene> scene;  ///< stand_in() of the frame's
    Settings settings;
    FrameRequest request;
};

class Rehearsals {
public:
    Rehearsals();
    /// Waits for the one under way.
    ~Rehearsals();

    /// When nothing was foreseen for a while, the last first.
    void foresee(Warmup warmup);
    /// Those of another scene or other shader files are no longer those meant.
    void forget();
    /// Until none is foreseen.
    void wait() const;
    /// How many were carried out.
    std::size_t done() const;

private:
    struct Stage;
    void run(const std::stop_token& end);
    std::unique_ptr<Warmup> take(const std::stop_token& end);

    mutable std::mutex mutex_;
    mutable std::condition_variable_any changed_;
    std::deque<Warmup> foreseen_;
    std::size_t done_ = 0, asked_ = 0;
    bool working_ = false;
    std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace si
