#include "app/editor/shader_warmup.h"

#include <chrono>

#if defined(__linux__)
#include <pthread.h>
#include <sched.h>
#endif

#include "app/context/headless_context.h"
#include "renderer/inspect/probe.h"

namespace si {
namespace {

using namespace std::chrono_literals;

constexpr auto kStill = 700ms;            ///< nothing is foreseen while settings move
constexpr int kWidth = 64, kHeight = 36;  ///< size of the warm-up pictures, pixels
constexpr std::size_t kMostForeseen = 3;  ///< the oldest give way

/// Has the thread take only what processor time nobody else wants.
void give_way() {
#if defined(__linux__)
    const sched_param none{};
    pthread_setschedparam(pthread_self(), SCHED_IDLE, &none);  // may fail, without harm
#endif
}

}  // namespace

/// Context and renderer of one warm-up frame. Each frame has its own: the driver keeps shaders without it, and llvmpipe
/// would keep the last images of a context, which may be maps of a gigabyte.
struct ShaderWarmup::Stage {
    HeadlessContext context;
    void play(const WarmupFrame& r) {
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
        // Once more with the maps kept, of which look-ups may then know more; another size, as nothing else is kept.
        request.force = false, ++request.width;
        renderer.render(*r.scene, r.settings, request);
        probe(renderer, r, request);
        renderer.take_gl_messages();
    }
    /// Draws probes until one hits a surface, because the background needs few of their shaders.
    static void probe(Renderer& renderer, const WarmupFrame& r, const FrameRequest& request) {
        for (int y = kHeight / 2; y < kHeight; y += kHeight / 4)
            for (int x = kWidth / 2; x < kWidth; x += kWidth / 4)
                if (renderer.probe(*r.scene, r.settings, request, x, y).hit) return;
    }
};

ShaderWarmup::ShaderWarmup() : thread_([this](const std::stop_token& end) { run(end); }) {}
ShaderWarmup::~ShaderWarmup() = default;

void ShaderWarmup::enqueue(WarmupFrame warmup) {
    {
        const std::lock_guard lock(mutex_);
        foreseen_.push_back(std::move(warmup));
        ++asked_;
        if (foreseen_.size() > kMostForeseen) foreseen_.pop_front();
    }
    changed_.notify_all();
}

void ShaderWarmup::forget() {
    const std::lock_guard lock(mutex_);
    foreseen_.clear();
}

void ShaderWarmup::wait() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return foreseen_.empty() && !working_; });
}

std::size_t ShaderWarmup::done() const {
    const std::lock_guard lock(mutex_);
    return done_;
}

std::unique_ptr<WarmupFrame> ShaderWarmup::next_frame(const std::stop_token& end) {
    std::unique_lock lock(mutex_);
    while (!end.stop_requested()) {
        if (!changed_.wait(lock, end, [&] { return !foreseen_.empty(); })) break;
        const std::size_t before = asked_;
        if (changed_.wait_for(lock, end, kStill, [&] { return asked_ != before; }) || foreseen_.empty()) continue;
        if (end.stop_requested()) break;
        auto next = std::make_unique<WarmupFrame>(std::move(foreseen_.back()));  // what was shown last
        foreseen_.pop_back();
        working_ = true;
        return next;
    }
    return {};
}

void ShaderWarmup::run(const std::stop_token& end) {
    give_way();
    while (const auto next = next_frame(end)) {
        try {
            Stage().play(*next);
        } catch (const std::exception&) {
            // The frame itself will fail alike, and say why.
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
