#include "app/editor/rehearsals.h"

#include <chrono>

#include "app/context/headless_context.h"
#include "renderer/inspect/probe.h"

namespace si {
namespace {

using namespace std::chrono_literals;

constexpr auto kStill = 300ms;            ///< nothing is foreseen while settings move
constexpr int kWidth = 64, kHeight = 36;  ///< of pictures that nobody sees
constexpr std::size_t kMostForeseen = 8;  ///< the oldest give way

}  // namespace

/// What a rehearsal takes place on; made when there is first one.
struct Rehearsals::Stage {
    HeadlessContext context;
    /// Programs are the driver's to keep; images of the last rehearsal are not.
    void play(const Rehearsal& r) {
        Renderer renderer;
        FrameRequest request = r.request;
        request.width = kWidth, request.height = kHeight;
        request.force = true, request.timing = false;
        request.truth.reset(), request.traced.clear(), request.light_maps.clear();
        renderer.render(*r.scene, r.settings, request);
        if (r.probe) renderer.probe(*r.scene, r.settings, request, kWidth / 2, kHeight / 2);
        renderer.take_gl_messages();
    }
};

Rehearsals::Rehearsals() : thread_([this](const std::stop_token& end) { run(end); }) {}
Rehearsals::~Rehearsals() = default;

void Rehearsals::want(Rehearsal rehearsal) {
    {
        const std::lock_guard lock(mutex_);
        waited_for_ = rehearsal.key;
        wanted_ = std::make_unique<Rehearsal>(std::move(rehearsal));
    }
    changed_.notify_all();
}

void Rehearsals::foresee(Rehearsal rehearsal) {
    {
        const std::lock_guard lock(mutex_);
        foreseen_.push_back(std::move(rehearsal));
        if (foreseen_.size() > kMostForeseen) foreseen_.pop_front();
    }
    changed_.notify_all();
}

bool Rehearsals::knows(std::uint64_t key) const {
    const std::lock_guard lock(mutex_);
    moved_ = false;
    return known_.contains(key);
}

bool Rehearsals::is_wanted(std::uint64_t key) const {
    const std::lock_guard lock(mutex_);
    return waited_for_ == key;
}

void Rehearsals::learn(std::uint64_t key) {
    const std::lock_guard lock(mutex_);
    if (key != 0) known_.insert(key);
    wanted_.reset();
    waited_for_ = 0;
}

void Rehearsals::forget() {
    const std::lock_guard lock(mutex_);
    known_.clear(), foreseen_.clear(), wanted_.reset();
    waited_for_ = 0;
    ++age_;
}

bool Rehearsals::busy() const {
    const std::lock_guard lock(mutex_);
    return waited_for_ != 0;
}

bool Rehearsals::moved() const {
    const std::lock_guard lock(mutex_);
    return moved_;
}

void Rehearsals::wait() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return waited_for_ == 0 || moved_; });
}

void Rehearsals::wait_for_all() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !wanted_ && foreseen_.empty() && !working_; });
}

std::size_t Rehearsals::done() const {
    const std::lock_guard lock(mutex_);
    return done_;
}

std::unique_ptr<Rehearsal> Rehearsals::take(const std::stop_token& end) {
    std::unique_lock lock(mutex_);
    while (!end.stop_requested()) {
        if (wanted_) return working_ = true, std::move(wanted_);
        if (foreseen_.empty()) {
            changed_.wait(lock, end, [&] { return wanted_ || !foreseen_.empty(); });
            continue;
        }
        if (changed_.wait_for(lock, end, kStill, [&] { return bool(wanted_); })) continue;
        if (end.stop_requested() || foreseen_.empty()) continue;
        auto next = std::make_unique<Rehearsal>(std::move(foreseen_.front()));
        foreseen_.pop_front();
        if (!next->probe && known_.contains(next->key)) {
            changed_.notify_all();
            continue;
        }
        return working_ = true, std::move(next);
    }
    return {};
}

void Rehearsals::run(const std::stop_token& end) {
    std::unique_ptr<Stage> stage;
    std::uint64_t age = 0;
    while (const auto next = take(end)) {
        {
            const std::lock_guard lock(mutex_);
            age = age_;
        }
        try {
            if (!stage) stage = std::make_unique<Stage>();
            stage->play(*next);
        } catch (const std::exception&) {
            // The frame itself will fail alike, and say why.
        }
        {
            const std::lock_guard lock(mutex_);
            working_ = false;
            ++done_;
            if (age == age_) known_.insert(next->key);
            if (wanted_ && known_.contains(wanted_->key)) wanted_.reset();
            if (waited_for_ != 0 && known_.contains(waited_for_)) moved_ = true;
        }
        changed_.notify_all();
    }
}

}  // namespace si
