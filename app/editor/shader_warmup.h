// Compiles the shaders of likely next frames on a thread with an OpenGL context of its own, while nothing else happens.
// The driver's shader cache passes them on to the renderer's context; without such a cache nothing is gained.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

#include "renderer/render/renderer.h"

namespace si {

/// A frame whose shaders are compiled, including those of its probe.
struct WarmupFrame {
    std::shared_ptr<const Scene> scene;  ///< proxy of the frame's scene, by stand_in()
    Settings settings;
    FrameRequest request;
};

/// Queue of frames and the thread that draws them for their shaders.
class ShaderWarmup {
public:
    ShaderWarmup();
    /// Waits for the frame under way.
    ~ShaderWarmup();

    /// Queues a frame. The thread starts when nothing has been queued for a while, with the newest frame.
    void foresee(WarmupFrame warmup);
    /// Empties the queue, when scene or shader files have changed.
    void forget();
    /// Waits until the queue is empty.
    void wait() const;
    /// Returns the number of frames that were drawn.
    std::size_t done() const;

private:
    struct Stage;
    void run(const std::stop_token& end);
    std::unique_ptr<WarmupFrame> take(const std::stop_token& end);

    mutable std::mutex mutex_;
    mutable std::condition_variable_any changed_;
    std::deque<WarmupFrame> foreseen_;
    std::size_t done_ = 0, asked_ = 0;
    bool working_ = false;
    std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace si
