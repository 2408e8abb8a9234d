// A thread that measures: a sweep case by case, and between its steps the present settings. It draws in an OpenGL
// context of its own, so that whoever asks is never kept waiting.
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

class MeasuringThread {
public:
    /// @param kept how long maps, programs and the context stay after there was something to measure
    explicit MeasuringThread(std::chrono::milliseconds kept = std::chrono::seconds(5));
    /// Cancels and joins.
    ~MeasuringThread();

    /// What a picture is measured of. The scene is shared, never changed.
    struct Picture {
        std::shared_ptr<const Scene> scene;
        std::string scene_name;
        Settings settings;
        int width = 0, height = 0;
        CostCase cost = kDefaultCost;  ///< of which frames the time is
    };
    /// In place of the sweep under way. @param scene that its cases begin with, standing as `as` says; copied
    void sweep(RunningSweep::Of of, std::shared_ptr<const Scene> scene, const SceneSettings& as);
    void cancel_sweep();
    /// In place of the picture under way.
    void measure(Picture picture);
    void cancel_measure();

    /// What became of it so far. Versions grow with each change.
    struct News {
        std::uint64_t version = 0;
        bool sweeping = false;
        SweepProgress progress;
        std::optional<SweepResults> results;  ///< of the sweep; none yet
        std::uint64_t sweep = 0;              ///< counts the sweeps
        std::string sweep_problem;            ///< why it ended early
        bool measuring = false;               ///< a picture is wanted and not there yet
        std::optional<CaseNumbers> measured;  ///< of the last picture
        std::string measure_problem;
    };
    News news() const;
    std::uint64_t version() const;
    bool busy() const;
    /// Until nothing is wanted any more.
    void wait() const;
    /// Until no sweep is under way.
    void wait_for_sweep() const;

private:
    struct SweepWanted {
        RunningSweep::Of of;
        std::shared_ptr<const Scene> scene;
        SceneSettings as;
        std::stop_source stop;
    };
    struct PictureWanted {
        Picture picture;
        std::stop_source stop;
        std::chrono::steady_clock::time_point due;
    };
    struct Bench;
    void run(const std::stop_token& end, std::chrono::milliseconds kept);
    void take_sweep(Bench& bench);
    void step_sweep(Bench& bench);
    void measure_picture(Bench& bench, const PictureWanted& wanted);
    /// Changes the news and wakes who waits.
    template <typename Change>
    void tell(const Change& change);

    mutable std::mutex mutex_;
    mutable std::condition_variable_any changed_;
    std::optional<SweepWanted> next_sweep_;
    std::optional<PictureWanted> next_picture_;
    std::stop_source sweep_stop_, picture_stop_;  ///< of what is wanted or under way
    News news_;
    std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace si
