#include "app/editor/shader_warmup.h"

#include <pthread.h>
#include <sched.h>

#include <chrono>

#include "app/context/headless_context.h"
#include "renderer/inspect/probe.h"

namespace si {
namespace {

using namespace std::chrono_literals;

constexpr auto kStill = 700ms;            ///< time without new frames before the thread starts
constexpr int kWidth = 64, kHeight = 36;  ///< size of the warm-up pictures, pixels
constexpr std::size_t kMaxQueued = 3;     ///< largest length of the queue; the oldest frames are dropped

/// Gives the thread the lowest priority, so that it uses idle processor time only.
void lower_priority() {
    const sched_param none{};
    pthread_setschedparam(pthread_self(), SCHED_IDLE, &none);  // a failure is harmless
}

/// Draws probes until one hits a surface, because the background needs few of their shaders.
void draw_probes(Renderer& renderer, const WarmupFrame& r, const FrameRequest& request) {
    for (int y = kHeight / 2; y < kHeight; y += kHeight / 4)
        for (int x = kWidth / 2; x < kWidth; x += kWidth / 4)
            if (renderer.probe(*r.scene, r.settings, request, x, y).hit) return;
}

/// Draws one warm-up frame with a context and renderer of its own: the driver keeps shaders without them, and llvmpipe
/// would keep the last images of a context, which may be maps of a gigabyte.
void draw_frame(const WarmupFrame& r) {
    const HeadlessContext context;
    Renderer renderer;
    FrameRequest request = r.request;
    request.width = kWidth;
    request.height = kHeight;
    request.force = true;
    request.timing = false;
    request.reference.reset();
    request.traced.clear();
    request.light_maps.clear();
    renderer.render(*r.scene, r.settings, request);
    // The second frame uses cached maps, whose look-ups may have other shaders. Its size differs, so that the rest is
    // drawn again.
    request.force = false;
    ++request.width;
    renderer.render(*r.scene, r.settings, request);
    draw_probes(renderer, r, request);
    renderer.take_gl_messages();
}

}  // namespace

ShaderWarmup::ShaderWarmup() : thread_([this](const std::stop_token& end) { run(end); }) {}

void ShaderWarmup::enqueue(WarmupFrame warmup) {
    {
        const std::lock_guard lock(mutex_);
        queue_.push_back(std::move(warmup));
        ++queued_count_;
        if (queue_.size() > kMaxQueued) queue_.pop_front();
    }
    changed_.notify_all();
}

void ShaderWarmup::forget() {
    const std::lock_guard lock(mutex_);
    queue_.clear();
}

void ShaderWarmup::wait() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return queue_.empty() && !working_; });
}

std::size_t ShaderWarmup::done() const {
    const std::lock_guard lock(mutex_);
    return done_;
}

std::unique_ptr<WarmupFrame> ShaderWarmup::next_frame(const std::stop_token& end) {
    std::unique_lock lock(mutex_);
    while (!end.stop_requested()) {
        if (!changed_.wait(lock, end, [&] { return !queue_.empty(); })) break;
        const std::size_t before = queued_count_;
        if (changed_.wait_for(lock, end, kStill, [&] { return queued_count_ != before; }) || queue_.empty()) continue;
        if (end.stop_requested()) break;
        auto next = std::make_unique<WarmupFrame>(std::move(queue_.back()));  // newest frame first
        queue_.pop_back();
        working_ = true;
        return next;
    }
    return {};
}

void ShaderWarmup::run(const std::stop_token& end) {
    lower_priority();
    while (const auto next = next_frame(end)) {
        try {
            draw_frame(*next);
        } catch (const std::exception&) {
            // The frame itself will fail in the same way and report the reason.
        }
        {
            const std::lock_guard lock(mutex_);
            working_ = false;
            ++done_;
        }
        changed_.notify_all();
    }
}

}  // namespace si
