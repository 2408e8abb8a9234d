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

/// Background thread for sweeps and single measurements.
class MeasuringThread {
public:
    /// Starts the measuring thread. @param kept time that maps, programs and the GL context stay in memory after the
    /// last measurement
    explicit MeasuringThread(std::chrono::milliseconds kept = std::chrono::seconds(5));
    /// Cancels all work and joins the thread.
    ~MeasuringThread();

    /// Picture whose error, cost and time are to be measured. The scene is shared and never changed.
    struct Picture {
        std::shared_ptr<const Scene> scene;
        Settings settings;
        int width = 0, height = 0;
        CostCase cost = kFrontierCost;  ///< kind of frames to time
    };
    /// Starts a sweep and cancels the running one. @param scene scene of the first case, which the sweep copies
    /// @param as scene settings (index, animation, time, placement) under which `scene` is posed
    void start_sweep(RunningSweep::Inputs inputs, std::shared_ptr<const Scene> scene, const SceneSettings& as);
    /// Stops the running sweep. Finished cases stay in its journal.
    void cancel_sweep();
    /// Starts measuring a picture and cancels the present measurement of a picture.
    void start_measurement(Picture picture);
    /// Stops the measurement of a picture.
    void cancel_measurement();

    /// State of the measuring thread: progress and results of sweep and single measurement. The version grows with each
    /// change.
    struct Status {
        std::uint64_t version = 0;
        bool sweeping = false;
        SweepProgress progress;
        std::optional<SweepResults> results;  ///< results of the sweep so far; none yet
        std::uint64_t sweep = 0;              ///< number of sweeps started
        std::string sweep_problem;            ///< why the sweep ended early
        bool measuring = false;               ///< a picture is being measured
        std::optional<CaseNumbers> measured;  ///< numbers of the last picture
        std::string measure_problem;
    };
    /// Returns a copy of the measuring thread's present state.
    Status status() const;
    /// Returns Status::version without copying the state.
    std::uint64_t version() const;
    /// Returns true while a sweep or a measurement runs.
    bool busy() const;
    /// Blocks until neither a sweep nor a measurement runs or waits.
    void wait() const;
    /// Blocks until no sweep runs.
    void wait_for_sweep() const;

private:
    /// Sweep that waits to be started.
    struct SweepWanted {
        RunningSweep::Inputs inputs;
        std::shared_ptr<const Scene> scene;
        SceneSettings as;
        std::stop_source stop;
    };
    /// Picture that waits to be measured.
    struct PictureWanted {
        Picture picture;
        std::stop_source stop;
        std::chrono::steady_clock::time_point due;
    };
    struct Bench;
    /// Measures pictures and steps of the sweep until `end` is requested. Loop of the thread. @param kept the time for
    /// which the OpenGL context stays in memory after the last measurement
    void run(const std::stop_token& end, std::chrono::milliseconds kept);
    /// Starts the waiting sweep.
    void begin_sweep(Bench& bench);
    /// Measures the next step of the running sweep.
    void step_sweep(Bench& bench);
    /// Measures a requested picture (start_measurement()) and publishes the numbers in the thread's status: first error
    /// and cost, then the frame time. A failure is published as text.
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
