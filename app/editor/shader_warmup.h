// Compiles the shaders of likely next frames on a thread with an OpenGL context of its own, while nothing else happens.
// The driver's shader cache passes them on to the renderer's context; without such a cache nothing is gained.
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

#include "renderer/render/renderer.h"

namespace si {

/// Frame whose shaders the warm-up compiles, including those of its probe.
struct WarmupFrame {
    std::shared_ptr<const Scene> scene;  ///< proxy of the frame's scene, by stand_in()
    Settings settings;
    FrameRequest request;
};

/// Background thread that draws queued frames so that the driver compiles their shaders in advance. Its destructor
/// waits for the frame under way.
class ShaderWarmup {
public:
    ShaderWarmup();

    /// Queues a frame whose shaders a hover, a click or the map viewer will need at the present settings. The thread
    /// starts once nothing was queued for a while, with the newest frame.
    void enqueue(WarmupFrame warmup);
    /// Empties the queue of frames. Call when the scene or shader files have changed.
    void forget();
    /// Waits until the queue of frames is empty.
    void wait() const;
    /// Returns the number of frames whose shaders were compiled.
    std::size_t done() const;

private:
    /// Draws queued frames one by one until `end` is requested, only to compile their shaders. Loop of the warm-up
    /// thread.
    void run(const std::stop_token& end);
    /// Waits for a queued frame and removes it from the queue; null once `end` is requested.
    std::unique_ptr<WarmupFrame> next_frame(const std::stop_token& end);

    mutable std::mutex mutex_;
    mutable std::condition_variable_any changed_;
    std::deque<WarmupFrame> queue_;
    std::size_t done_ = 0, queued_count_ = 0;
    bool working_ = false;
    std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace si
