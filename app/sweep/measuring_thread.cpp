#include "app/sweep/measuring_thread.h"

#include <algorithm>

#include "app/context/headless_context.h"

namespace si {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kSettleTime = 200ms;      ///< time without changes before a picture is measured
constexpr auto kReportInterval = 250ms;  ///< time between two reports of a sweep's results

/// Returns the workers for measurements, which leave one CPU thread to the editor.
Workers workers_of(std::stop_token stop) {
    return {.threads = std::max(1, Workers{}.count() - 1), .stop = std::move(stop)};
}

}  // namespace

/// OpenGL context, renderer and measurer of the thread, made at the first measurement.
struct MeasuringThread::Bench {
    HeadlessContext context;
    Renderer renderer;
    std::unique_ptr<RunningSweep> sweep;
    std::stop_token sweep_stop;
    Clock::time_point report_due;
    std::unique_ptr<Measurer> measurer;  ///< for pictures; keeps the reference from one to the next
    int width = 0, height = 0;
};

MeasuringThread::MeasuringThread(std::chrono::milliseconds kept)
    : thread_([this, kept](const std::stop_token& end) { run(end, kept); }) {}

MeasuringThread::~MeasuringThread() {
    cancel_sweep();
    cancel_measurement();
}

template <typename Change>
void MeasuringThread::update_status(const Change& change) {
    {
        const std::lock_guard lock(mutex_);
        change();
        ++status_.version;
    }
    changed_.notify_all();
}

void MeasuringThread::start_sweep(RunningSweep::Inputs inputs, std::shared_ptr<const Scene> scene,
                                  const SceneSettings& as) {
    update_status([&] {
        sweep_stop_.request_stop();
        sweep_stop_ = {};
        next_sweep_ = SweepWanted{std::move(inputs), std::move(scene), as, sweep_stop_};
        status_.sweeping = true;
        status_.progress = {};
        status_.results.reset();
        status_.sweep_problem.clear();
        ++status_.sweep;
    });
}

void MeasuringThread::cancel_sweep() {
    update_status([&] {
        sweep_stop_.request_stop();
        if (next_sweep_) {
            next_sweep_.reset();
            status_.sweeping = false;
        }
    });
}

void MeasuringThread::start_measurement(Picture picture) {
    update_status([&] {
        picture_stop_.request_stop();
        picture_stop_ = {};
        next_picture_ = PictureWanted{std::move(picture), picture_stop_, Clock::now() + kSettleTime};
        status_.measuring = true;
        status_.measured.reset();
        status_.measure_problem.clear();
    });
}

void MeasuringThread::cancel_measurement() {
    update_status([&] {
        picture_stop_.request_stop();
        next_picture_.reset();
        status_.measuring = false;
    });
}

MeasuringThread::Status MeasuringThread::status() const {
    const std::lock_guard lock(mutex_);
    return status_;
}

std::uint64_t MeasuringThread::version() const {
    const std::lock_guard lock(mutex_);
    return status_.version;
}

bool MeasuringThread::busy() const {
    const std::lock_guard lock(mutex_);
    return status_.sweeping || status_.measuring;
}

void MeasuringThread::wait() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !status_.sweeping && !status_.measuring; });
}

void MeasuringThread::wait_for_sweep() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !status_.sweeping; });
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
                    bench.reset();  // frees its maps, which may be large
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
            update_status([&] {
                next_sweep_.reset();
                next_picture_.reset();
                status_.sweeping = status_.measuring = false;
                status_.sweep_problem = status_.measure_problem = e.what();
            });
            continue;
        }
        if (picture) measure_picture(*bench, *picture);
        if (new_sweep) begin_sweep(*bench);
        if (bench->sweep) step_sweep(*bench);
    }
}

void MeasuringThread::begin_sweep(Bench& bench) {
    std::optional<SweepWanted> wanted;
    {
        const std::lock_guard lock(mutex_);
        std::swap(wanted, next_sweep_);
    }
    if (!wanted) return;
    bench.sweep.reset();  // closes its journal
    try {
        wanted->inputs.sessions.add_scene(*wanted->scene, wanted->as);
        bench.sweep_stop = wanted->stop.get_token();
        bench.sweep =
            std::make_unique<RunningSweep>(std::move(wanted->inputs), bench.renderer, workers_of(bench.sweep_stop));
        bench.report_due = Clock::now() + kReportInterval;
    } catch (const std::exception& e) {
        update_status([&] {
            status_.sweeping = false;
            status_.sweep_problem = e.what();
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
        results = sweep_results(bench.sweep->state(), bench.sweep->inputs().plan);
        bench.report_due = Clock::now() + kReportInterval;
    }
    const SweepProgress progress = bench.sweep->progress();
    if (!more) bench.sweep.reset();  // closes the journal before the end is reported
    update_status([&] {
        if (next_sweep_) return;  // another sweep waits already
        if (report) status_.results = std::move(results);
        status_.progress = progress;
        status_.sweeping = more;
        status_.sweep_problem = problem;
    });
}

void MeasuringThread::measure_picture(Bench& bench, const PictureWanted& wanted) {
    const Picture& p = wanted.picture;
    const auto publish = [&](const std::optional<CaseNumbers>& measured, const std::string& problem, bool done) {
        update_status([&] {
            if (wanted.stop.stop_requested()) return;
            status_.measured = measured;
            status_.measure_problem = problem;
            if (done) status_.measuring = false;
        });
    };
    CaseNumbers numbers;
    try {
        if (!bench.measurer || bench.width != p.width || bench.height != p.height)
            bench.measurer = std::make_unique<Measurer>(bench.renderer, p.width, p.height);
        bench.width = p.width;
        bench.height = p.height;
        bench.measurer->set_workers(workers_of(wanted.stop.get_token()));
        const Classification classified = bench.measurer->classify(*p.scene, p.settings);
        numbers.error = {classified.error, classified.reference->noise};
        numbers.cost = classified.cost;
        publish(numbers, "", false);
        numbers.time = bench.measurer->time(*p.scene, p.settings, p.cost);
        numbers.shadow = measure_shadow_time(*bench.measurer, *p.scene, p.settings, wanted.stop.get_token());
        publish(numbers, "", true);
    } catch (const Cancelled&) {
    } catch (const std::exception& e) {
        publish({}, e.what(), true);
    }
}

}  // namespace si
