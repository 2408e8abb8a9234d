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

/// Frame that the shader warm-up draws so that the driver compiles its shaders, including those of its pixel probe.
struct WarmupFrame {
    std::shared_ptr<const Scene> scene;  ///< proxy of the frame's scene, by make_proxy_scene()
    Settings settings;
    FrameRequest request;
};

/// Background thread that draws queued frames so that the driver compiles their shaders in advance. Its destructor
/// waits for the frame under way.
class ShaderWarmup {
public:
    ShaderWarmup();

    /// Queues a frame whose shaders a hover, a click or the map viewer will need, for compilation in the background.
    /// The thread begins once no frame was queued for 0.7 s, with the newest frame.
    void enqueue(WarmupFrame warmup);
    /// Removes all frames from the queue of the shader warm-up. Call when the scene or shader files have changed.
    void forget();
    /// Waits until the shader warm-up has drawn all queued frames.
    void wait() const;
    /// Returns the number of frames that the shader warm-up has drawn, failed ones included.
    std::size_t done() const;

private:
    /// Draws queued frames one by one, only to compile their shaders, until `end` is requested. Runs as the warm-up
    /// thread.
    void run(const std::stop_token& end);
    /// Waits for a queued frame and removes the newest one from the queue. Returns null once `end` is requested.
    std::unique_ptr<WarmupFrame> next_frame(const std::stop_token& end);

    mutable std::mutex mutex_;
    mutable std::condition_variable_any changed_;
    std::deque<WarmupFrame> queue_;
    std::size_t done_ = 0, queued_count_ = 0;
    bool working_ = false;
    std::jthread thread_;  ///< declared last, so that its thread ends first
};

}  // namespace si
