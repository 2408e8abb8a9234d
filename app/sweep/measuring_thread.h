// Background thread that measures a sweep case by case, and the present settings between its steps. It draws in an
// OpenGL context of its own, so that the editor never waits.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "app/sweep/results.h"
#include "app/sweep/running_sweep.h"

namespace si {

/// Background thread that measures sweeps (many settings, case by case) and single pictures with an OpenGL context of
/// its own, so that the editor never waits.
class MeasuringThread {
public:
    /// Starts the measuring thread. @param kept time that maps, programs and the GL context stay in memory after the
    /// last measurement
    explicit MeasuringThread(std::chrono::milliseconds kept = std::chrono::seconds(5));
    /// Cancels all work and joins the thread.
    ~MeasuringThread();

    /// Picture whose error, cost and frame time the measuring thread measures. The scene is shared and never changed.
    struct Picture {
        std::shared_ptr<const Scene> scene;
        Settings settings;
        int width = 0, height = 0;
        CostCase cost = kFrontierCost;  ///< kind of frames to time
    };
    /// Starts a sweep on the measuring thread; a running sweep is cancelled.
    /// @param inputs plan, timing and folder of the sweep @param scene loaded scene, which the sweep copies so that its
    /// file is not read again @param as scene settings (index, animation, time, placement) under which `scene` is posed
    void start_sweep(RunningSweep::Inputs inputs, std::shared_ptr<const Scene> scene, const SceneSettings& as);
    /// Stops the running sweep of the measuring thread. Results of finished cases stay in the sweep's journal.
    void cancel_sweep();
    /// Starts to measure a picture on the measuring thread; the present measurement of a picture is cancelled. The work
    /// begins 200 ms later, so that a series of changes is measured once.
    void start_measurement(Picture picture);
    /// Stops the measurement of a picture on the measuring thread. A running sweep continues.
    void cancel_measurement();

    /// State of the measuring thread: progress and results of the sweep and of the single picture. `version` grows with
    /// each change.
    struct Status {
        std::uint64_t version = 0;
        bool sweeping = false;
        SweepProgress progress;
        std::optional<SweepResults> results;  ///< results of the sweep so far; nullopt: none yet
        std::uint64_t sweep = 0;              ///< number of sweeps started
        std::string sweep_problem;            ///< why the sweep ended early
        bool measuring = false;               ///< a picture is being measured
        std::optional<CaseNumbers> measured;  ///< numbers of the picture started last; nullopt: none yet
        std::string measure_problem;
    };
    /// Returns a copy of the present progress and results of the measuring thread. Any thread may call it.
    Status status() const;
    /// Returns a number that grows with each change of status(). Used to notice changes without copying the results.
    std::uint64_t version() const;
    /// Returns true while the measuring thread measures a sweep or a picture, or one waits to be measured.
    bool busy() const;
    /// Blocks the caller until the measuring thread has no sweep and no picture left to measure.
    void wait() const;
    /// Blocks the caller until the measuring thread has no sweep left to measure. Call after a sweep was cancelled,
    /// before another one is shown.
    void wait_for_sweep() const;

private:
    /// Queued sweep, which the measuring thread has not begun yet.
    struct SweepWanted {
        RunningSweep::Inputs inputs;
        std::shared_ptr<const Scene> scene;
        SceneSettings as;
        std::stop_source stop;
    };
    /// Picture that waits until the measuring thread measures it, at `due` or later.
    struct PictureWanted {
        Picture picture;
        std::stop_source stop;
        std::chrono::steady_clock::time_point due;
    };
    struct Bench;
    /// Runs the main loop of the measuring thread until `end` is requested. Measures single pictures, and a sweep step
    /// by step. A step measures error and cost of one case, or times some of its frames.
    /// @param kept time for which the OpenGL context stays in memory after the last measurement
    void run(const std::stop_token& end, std::chrono::milliseconds kept);
    /// Begins the sweep that start_sweep() has queued: opens its journal and passes it the scene that the editor has
    /// loaded, so that the scene's file is not read again. A failure becomes the text Status::sweep_problem.
    /// @param bench OpenGL context and renderer of the measuring thread
    void begin_sweep(Bench& bench);
    /// Measures the next step of the running sweep and publishes its progress. @param bench OpenGL context and renderer
    /// of the measuring thread
    void step_sweep(Bench& bench);
    /// Measures a requested picture (start_measurement()) and publishes its numbers: first error and cost, then the
    /// times of frame and shadows. A failure is published as text. @param bench OpenGL context and renderer of the
    /// measuring thread
    void measure_picture(Bench& bench, const PictureWanted& wanted);
    /// Applies a change to the status of the measuring thread, and wakes the threads that wait for a change.
    template <typename Change>
    void update_status(const Change& change);

    mutable std::mutex mutex_;
    mutable std::condition_variable_any changed_;
    std::optional<SweepWanted> next_sweep_;
    std::optional<PictureWanted> next_picture_;
    std::stop_source sweep_stop_, picture_stop_;  ///< stop the waiting or running work
    Status status_;
    std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace si
