#include "app/editor/rehearsals.h"

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
constexpr int kWidth = 64, kHeight = 36;  ///< of pictures that nobody sees
constexpr std::size_t kMostForeseen = 3;  ///< the oldest give way

/// Has the thread take only what processor time nobody else wants.
void give_way() {
#if defined(__linux__)
    const sched_param none{};
    pthread_setschedparam(pthread_self(), SCHED_IDLE, &none);  // a wish
#endif
}

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
        // Once more with the maps kept, of which look-ups may then know more; another size, as nothing else is kept.
        request.force = false, ++request.width;
        renderer.render(*r.scene, r.settings, request);
        if (r.probe) probe(renderer, r, request);
        renderer.take_gl_messages();
    }
    /// Of the background little is asked.
    static void probe(Renderer& renderer, const Rehearsal& r, const FrameRequest& request) {
        for (int y = kHeight / 2; y < kHeight; y += kHeight / 4)
            for (int x = kWidth / 2; x < kWidth; x += kWidth / 4)
                if (renderer.probe(*r.scene, r.settings, request, x, y).hit) return;
    }
};

Rehearsals::Rehearsals()
    : wanting_([this](const std::stop_token& end) { run(end, false); }),
      foreseeing_([this](const std::stop_token& end) { run(end, true); }) {}
Rehearsals::~Rehearsals() = default;

void Rehearsals::want(Rehearsal rehearsal) {
    {
        const std::lock_guard lock(mutex_);
        waited_for_ = rehearsal.key;
        wanted_ = std::make_unique<Rehearsal>(std::move(rehearsal));
        ++asked_;
    }
    changed_.notify_all();
}

void Rehearsals::foresee(Rehearsal rehearsal) {
    {
        const std::lock_guard lock(mutex_);
        foreseen_.push_back(std::move(rehearsal));
        ++asked_;
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
    changed_.wait(lock, [&] { return !wanted_ && foreseen_.empty() && working_ == 0; });
}

std::size_t Rehearsals::done() const {
    const std::lock_guard lock(mutex_);
    return done_;
}

std::unique_ptr<Rehearsal> Rehearsals::take_wanted(const std::stop_token& end) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait(lock, end, [&] { return bool(wanted_); })) return {};
    ++working_;
    return std::move(wanted_);
}

std::unique_ptr<Rehearsal> Rehearsals::take_foreseen(const std::stop_token& end) {
    std::unique_lock lock(mutex_);
    while (!end.stop_requested()) {
        if (!changed_.wait(lock, end, [&] { return !foreseen_.empty(); })) break;
        const std::size_t before = asked_;
        if (changed_.wait_for(lock, end, kStill, [&] { return asked_ != before; }) || foreseen_.empty()) continue;
        if (end.stop_requested()) break;
        auto next = std::make_unique<Rehearsal>(std::move(foreseen_.back()));  // what was shown last
        foreseen_.pop_back();
        ++working_;
        return next;
    }
    return {};
}

void Rehearsals::run(const std::stop_token& end, bool foreseen) {
    if (foreseen) give_way();
    std::unique_ptr<Stage> stage;
    std::uint64_t age = 0;
    while (const auto next = foreseen ? take_foreseen(end) : take_wanted(end)) {
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
            --working_;
            ++done_;
            if (age == age_) known_.insert(next->key);
            if (wanted_ && known_.contains(wanted_->key)) wanted_.reset();
            if (waited_for_ != 0 && known_.contains(waited_for_)) moved_ = true;
        }
        changed_.notify_all();
    }
}

}  // namespace si
