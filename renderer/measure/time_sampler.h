// How long a frame takes, told apart by pass: frames are added until the figure stands still.
#pragma once

#include <string>
#include <vector>

#include "renderer/frame.h"
#include "renderer/measure/frontier.h"

namespace si {

/// Pass times of several frames, one number a frame.
struct TimeSamples {
    struct Pass {
        std::string name;
        std::vector<double> gpu_ms, cpu_ms;
    };
    std::vector<double> total_ms;
    std::vector<double> maps_ms;  ///< of the passes that draw shadow maps
    std::vector<Pass> passes;     ///< those that ran, in the frame's order
    std::string clock;

    void add(const FrameResult& frame);
    void add(const TimeSamples& more);
};

struct PassTime {
    std::string name;
    Spread gpu_ms, cpu_ms;
};

struct TimeMeasurement {
    Spread total_ms;               ///< of the passes' times, frame by frame
    Spread maps_ms;                ///< of the passes that draw shadow maps
    Spread picture_ms;             ///< of all others: visibility and shading
    std::vector<PassTime> passes;  ///< those that ran, in the frame's order
    bool settled = false;          ///< the spread fell below the limit within the frames allowed
    std::string clock;             ///< what the times were taken with
};

/// Spread::relative() of the total below which a time has settled.
inline constexpr double kSettledSpread = 0.03;

/// @param settled_below bound of Spread::relative() of the total
TimeMeasurement summary(const TimeSamples& samples, double settled_below = kSettledSpread);

/// Collects the pass times of frames of one setting. Frames are to be drawn with FrameRequest::timing and ::force: a
/// pass whose result is reused takes no time, which would be the wrong answer.
class TimeSampler {
public:
    struct Limits {
        int least = 5, most = 60;  ///< frames
        double spread = kSettledSpread;
    };
    TimeSampler() : TimeSampler(Limits{}) {}
    explicit TimeSampler(const Limits& limits) : limits_(limits) {}

    /// The first frame warms up (programs are compiled, memory is touched) and is not counted.
    void add(const FrameResult& frame);
    int frames() const { return int(samples_.total_ms.size()); }
    bool settled() const;
    /// No further frame is wanted: settled, or the most frames were drawn.
    bool done() const { return settled() || frames() >= limits_.most; }
    TimeMeasurement result() const;
    const TimeSamples& samples() const { return samples_; }

private:
    Limits limits_;
    bool warm_ = false;
    TimeSamples samples_;
};

/// What a frame costs whatever machine draws it.
struct WorkCost {
    double taps_per_pixel = 0;          ///< texels fetched per light and lit pixel by the kernel, by gathers or a sampler
    std::uint64_t map_texels = 0;       ///< of all shadow maps
    std::uint64_t map_bytes = 0;        ///< that they take
    /// map_bytes, and what the kernel fetches were each pixel lit by each casting light.
    std::uint64_t bytes_touched = 0;
    std::uint64_t draws = 0, triangles = 0;  ///< of all passes that ran
};

/// @param frame drawn with FrameRequest::force, so that every pass counts
WorkCost work_cost(const Settings& settings, const FrameResult& frame);

}  // namespace si
