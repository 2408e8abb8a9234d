// How long a frame takes, told apart by pass: frames are added until the figure stands still.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "renderer/frame.h"
#include "renderer/measure/frontier.h"

namespace si {

struct PassTime {
    std::string name;
    Spread gpu_ms, cpu_ms;
};

struct TimeMeasurement {
    Spread total_ms;               ///< of the passes' times, frame by frame
    std::vector<PassTime> passes;  ///< those that ran, in the frame's order
    bool settled = false;          ///< the spread fell below the limit within the frames allowed
    std::string clock;             ///< what the times were taken with
};

/// Collects the pass times of frames of one setting. Frames are to be drawn with FrameRequest::timing and ::force: a pass
/// whose result is reused takes no time, which would be the wrong answer.
class TimeSampler {
public:
    struct Limits {
        int least = 5, most = 60;  ///< frames
        double spread = 0.03;      ///< Spread::relative() of the total below which it is settled
    };
    TimeSampler() : TimeSampler(Limits{}) {}
    explicit TimeSampler(const Limits& limits) : limits_(limits) {}

    /// The first frame warms up (programs are compiled, memory is touched) and is not counted.
    void add(const FrameResult& frame);
    int frames() const { return int(totals_.size()); }
    bool settled() const;
    /// No further frame is wanted: settled, or the most frames were drawn.
    bool done() const { return settled() || frames() >= limits_.most; }
    TimeMeasurement result() const;

private:
    struct Samples {
        std::vector<double> gpu, cpu;
    };
    Limits limits_;
    bool warm_ = false;
    std::vector<double> totals_;
    std::vector<std::string> order_;
    std::map<std::string, Samples> passes_;
    std::string clock_;
};

/// What a frame costs whatever machine draws it.
struct WorkCost {
    double taps_per_pixel = 0;          ///< texels or comparisons fetched per light and lit pixel by the kernel
    std::uint64_t map_texels = 0;       ///< of all shadow maps
    std::uint64_t map_bytes = 0;
    std::uint64_t draws = 0, triangles = 0;  ///< of all passes that ran
};

/// @param frame drawn with FrameRequest::force, so that every pass counts
WorkCost work_cost(const Settings& settings, const FrameResult& frame);

}  // namespace si
