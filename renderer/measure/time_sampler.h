// How long a frame takes, told apart by pass: frames are added, burst by burst, until the figure stands still.
//
//     const TimeMeasurement time = sample_times({}, [&] { return renderer.render(scene, settings, request); });
//     time.total_ms.median, time.total_ms.median_low ... median_high     // within this run of the program
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/measure/frame_costs.h"
#include "renderer/measure/frontier.h"

namespace si {

/// Pass times of several frames, one number a frame.
struct TimeSamples {
    struct Pass {
        std::string name;
        std::vector<double> gpu_ms, cpu_ms;
    };
    std::vector<double> total_ms;
    std::vector<double> maps_ms;  ///< of the passes that draw or change shadow maps
    std::vector<Pass> passes;     ///< those that ran, in the frame's order
    std::string clock;
    std::vector<std::size_t> bursts;  ///< first frame of each; the frames of one follow each other at once
    bool burst_ended = true;          ///< the next frame begins another

    void add(const FrameResult& frame);
    /// Bursts of their own.
    void add(const TimeSamples& more);
};

struct PassTime {
    std::string name;
    Spread gpu_ms, cpu_ms;
};

struct TimeMeasurement {
    Spread total_ms;               ///< of the passes' times, frame by frame
    Spread maps_ms;                ///< of the passes that draw or change shadow maps
    Spread picture_ms;             ///< of all others: visibility and shading
    std::vector<PassTime> passes;  ///< those that ran, in the frame's order
    bool settled = false;          ///< the spread fell below the limit within the frames allowed, over several bursts
    double seconds = 0;            ///< from the first frame to the last; 0: not known
    std::string clock;             ///< what the times were taken with
    CostCase cost = CostCase::Forced;  ///< of which frames
};

/// Spread::relative() of the total below which a time has settled.
inline constexpr double kSettledSpread = 0.03;
/// Bursts below which nothing is known of how they differ, so that no time has settled.
inline constexpr int kMinBursts = 3;

/// @param settled_below bound of Spread::relative() of the total
TimeMeasurement summary(const TimeSamples& samples, double settled_below = kSettledSpread);

/// Collects the pass times of frames of one setting. A pass whose result is reused takes no time: frames are to be
/// drawn so that this is the answer (set_timed_passes()). They come in bursts spread over a while, since a machine's
/// mood lasts longer than a few frames.
class TimeSampler {
public:
    struct Limits {
        int least = 5, most = 60;  ///< frames
        double spread = kSettledSpread;
        int bursts = 5;     ///< at least
        double over_s = 1;  ///< that these are spread over, at least
    };
    TimeSampler() : TimeSampler(Limits{}) {}
    explicit TimeSampler(const Limits& limits) : limits_(limits) {}

    /// The first frame, and the first after a pause, warms up (programs are compiled, memory is touched, clocks rise)
    /// and is not counted. @param now_s when it was done, by any clock
    void add(const FrameResult& frame, double now_s);
    /// How long to wait before the next frame; 0: at once.
    double pause_s() const { return pause_s_; }
    int frames() const { return int(samples_.total_ms.size()); }
    bool settled() const;
    /// No further frame is wanted: settled, or the most frames were drawn.
    bool done() const { return settled() || frames() >= limits_.most; }
    TimeMeasurement result() const;

private:
    static constexpr int kBurstFrames = 3;

    Limits limits_;
    TimeSamples samples_;
    bool begun_ = false, warm_ = false;
    double start_s_ = 0, burst_s_ = 0, last_s_ = 0;  ///< when the first frame, the burst, the last frame was
    double pause_s_ = 0;
    int ended_ = 0, in_burst_ = 0;  ///< bursts; frames of the present one
};

/// Seconds by some clock, and how to let some pass.
struct BurstClock {
    std::function<double()> now_s;
    std::function<void(double)> wait_s;
    static BurstClock steady();
};

/// Draws until the time stands still or the most frames were drawn. What `draw` throws ends it.
TimeMeasurement sample_times(const TimeSampler::Limits& limits, const std::function<FrameResult()>& draw,
                             const BurstClock& clock = BurstClock::steady());

/// What a frame costs whatever machine draws it.
struct WorkCost {
    double taps_per_pixel = 0;     ///< texels fetched per light and lit pixel by the kernel, by gathers or a sampler
    std::uint64_t map_texels = 0;  ///< of all shadow maps
    std::uint64_t map_bytes = 0;   ///< that they take, copies of map.blur_texels included, and light maps
    /// map_bytes, and what the kernel or the light map fetches were each pixel lit by each casting light.
    std::uint64_t bytes_touched = 0;
    std::uint64_t draws = 0, triangles = 0;  ///< of all passes that ran
};

/// @param frame drawn with FrameRequest::force, so that every pass counts
WorkCost work_cost(const Settings& settings, const FrameResult& frame);

}  // namespace si
