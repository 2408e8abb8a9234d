#include "app/sweep/measuring_thread.h"

#include <algorithm>

#include "app/context/headless_context.h"

namespace si {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kRest = 200ms;    ///< a picture waits this long for settings to stand still
constexpr auto kReport = 250ms;  ///< between two reports of a sweep's results

/// One thread is left to the editor.
Workers workers_of(std::stop_token stop) {
    return {.threads = std::max(1, Workers{}.count() - 1), .stop = std::move(stop)};
}

}  // namespace

/// What the thread measures with; made when there is first something to measure.
struct MeasuringThread::Bench {
    HeadlessContext context;
    Renderer renderer;
    std::unique_ptr<RunningSweep> sweep;
    std::stop_token sweep_stop;
    Clock::time_point report_due;
    std::unique_ptr<Measurer> measurer;  ///< of pictures; keeps the truth from one to the next
    int width = 0, height = 0;
};

MeasuringThread::MeasuringThread(std::chrono::milliseconds kept)
    : thread_([this, kept](const std::stop_token& end) { run(end, kept); }) {}

MeasuringThread::~MeasuringThread() {
    cancel_sweep();
    cancel_measure();
}

template <typename Change>
void MeasuringThread::tell(const Change& change) {
    {
        const std::lock_guard lock(mutex_);
        change();
        ++news_.version;
    }
    changed_.notify_all();
}

void MeasuringThread::sweep(RunningSweep::Of of, std::shared_ptr<const Scene> scene, const SceneSettings& as) {
    tell([&] {
        sweep_stop_.request_stop();
        sweep_stop_ = {};
        next_sweep_ = SweepWanted{std::move(of), std::move(scene), as, sweep_stop_};
        news_.sweeping = true;
        news_.progress = {};
        news_.results.reset();
        news_.sweep_problem.clear();
        ++news_.sweep;
    });
}

void MeasuringThread::cancel_sweep() {
    tell([&] {
        sweep_stop_.request_stop();
        if (next_sweep_) {
            next_sweep_.reset();
            news_.sweeping = false;
        }
    });
}

void MeasuringThread::measure(Picture picture) {
    tell([&] {
        picture_stop_.request_stop();
        picture_stop_ = {};
        next_picture_ = PictureWanted{std::move(picture), picture_stop_, Clock::now() + kRest};
        news_.measuring = true;
        news_.measure_problem.clear();
    });
}

void MeasuringThread::cancel_measure() {
    tell([&] {
        picture_stop_.request_stop();
        next_picture_.reset();
        news_.measuring = false;
    });
}

MeasuringThread::News MeasuringThread::news() const {
    const std::lock_guard lock(mutex_);
    return news_;
}

std::uint64_t MeasuringThread::version() const {
    const std::lock_guard lock(mutex_);
    return news_.version;
}

bool MeasuringThread::busy() const {
    const std::lock_guard lock(mutex_);
    return news_.sweeping || news_.measuring;
}

void MeasuringThread::wait() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !news_.sweeping && !news_.measuring; });
}

void MeasuringThread::wait_for_sweep() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !news_.sweeping; });
}

void MeasuringThread::run(const std::stop_token& end, std::chrono::milliseconds kept) {
    std::unique_ptr<Bench> bench;
    while (!end.stop_requested()) {
        std::optional<PictureWanted> picture;
        bool new_sweep = false;
        {
            std::unique_lock lock(mutex_);
            const auto due = [&] { return next_picture_ && next_picture_->due <= Clock::now(); };
            const bool sweeping = bench && bench->sweep;
            while (!end.stop_requested() && !sweeping && !next_sweep_ && !due()) {
                if (next_picture_)
                    changed_.wait_until(lock, end, next_picture_->due, [&] { return next_sweep_ || due(); });
                else if (!bench)
                    changed_.wait(lock, end, [&] { return next_sweep_ || next_picture_; });
                else if (!changed_.wait_for(lock, end, kept, [&] { return next_sweep_ || next_picture_; }) &&
                         !end.stop_requested()) {
                    lock.unlock();
                    bench.reset();  // its maps may be large, and are nobody's
                    lock.lock();
                }
            }
            if (due()) {
                picture = std::move(next_picture_);
                next_picture_.reset();
            }
            new_sweep = next_sweep_.has_value();
        }
        if (end.stop_requested()) break;
        try {
            if (!bench) bench = std::make_unique<Bench>();
        } catch (const std::exception& e) {
            tell([&] {
                next_sweep_.reset();
                next_picture_.reset();
                news_.sweeping = news_.measuring = false;
                news_.sweep_problem = news_.measure_problem = e.what();
            });
            continue;
        }
        if (picture) measure_picture(*bench, *picture);
        if (new_sweep) take_sweep(*bench);
        if (bench->sweep) step_sweep(*bench);
    }
}

void MeasuringThread::take_sweep(Bench& bench) {
    std::optional<SweepWanted> wanted;
    {
        const std::lock_guard lock(mutex_);
        std::swap(wanted, next_sweep_);
    }
    if (!wanted) return;
    bench.sweep.reset();  // leaves its journal
    try {
        wanted->of.sessions.keep(*wanted->scene, wanted->as);
        bench.sweep_stop = wanted->stop.get_token();
        bench.sweep =
            std::make_unique<RunningSweep>(std::move(wanted->of), bench.renderer, workers_of(bench.sweep_stop));
        bench.report_due = Clock::now() + kReport;
    } catch (const std::exception& e) {
        tell([&] {
            news_.sweeping = false;
            news_.sweep_problem = e.what();
        });
    }
}

void MeasuringThread::step_sweep(Bench& bench) {
    bool more = false;
    std::string problem;
    try {
        more = !bench.sweep_stop.stop_requested() && bench.sweep->step();
    } catch (const Cancelled&) {
    } catch (const std::exception& e) {
        problem = e.what();
    }
    const bool report = !more || Clock::now() >= bench.report_due;
    std::optional<SweepResults> results;
    if (report) {
        results = sweep_results(bench.sweep->state(), bench.sweep->of().plan);
        bench.report_due = Clock::now() + kReport;
    }
    const SweepProgress progress = bench.sweep->progress();
    if (!more) bench.sweep.reset();  // the journal is free before anybody hears of the end
    tell([&] {
        if (next_sweep_) return;  // another one is wanted already
        if (report) news_.results = std::move(results);
        news_.progress = progress;
        news_.sweeping = more;
        news_.sweep_problem = problem;
    });
}

void MeasuringThread::measure_picture(Bench& bench, const PictureWanted& wanted) {
    const Picture& p = wanted.picture;
    const auto publish = [&](const std::optional<CaseNumbers>& measured, const std::string& problem, bool done) {
        tell([&] {
            if (wanted.stop.stop_requested()) return;
            news_.measured = measured;
            news_.measure_problem = problem;
            if (done) news_.measuring = false;
        });
    };
    CaseNumbers numbers;
    try {
        if (!bench.measurer || bench.width != p.width || bench.height != p.height)
            bench.measurer = std::make_unique<Measurer>(bench.renderer, p.width, p.height);
        bench.width = p.width;
        bench.height = p.height;
        bench.measurer->set_workers(workers_of(wanted.stop.get_token()));
        const Judgement classified = bench.measurer->judge(*p.scene, p.settings);
        numbers.error = {classified.error, classified.reference->noise};
        numbers.cost = classified.cost;
        publish(numbers, "", false);
        numbers.time = bench.measurer->time(*p.scene, p.settings, p.cost);
        publish(numbers, "", true);
    } catch (const Cancelled&) {
    } catch (const std::exception& e) {
        publish({}, e.what(), true);
    }
}

}  // namespace si
