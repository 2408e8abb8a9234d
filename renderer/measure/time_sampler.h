// Timing of frames by pass: frames are drawn in bursts until the median has settled.
//
//     const TimeMeasurement time = sample_times({}, [&] { return renderer.render(scene, settings, request); });
//     time.total_ms.median, time.total_ms.median_low ... median_high     // within this run of the program
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/measure/frame_costs.h"
#include "renderer/measure/frontier.h"

namespace si {

/// Returns the summed time of a frame's drawn passes, milliseconds, without uploads of imported maps.
/// @param of category of the passes to count; nullopt: all @param time member of PassInfo to sum
double drawn_ms(const FrameResult& frame, std::optional<PassCategory> of = {},
                double PassInfo::*time = &PassInfo::gpu_ms);

/// Times of several frames in milliseconds, one number per frame: in total, for the shadow maps, and for each pass.
struct TimeSamples {
    /// Times of one render pass, one number per frame in which the pass ran.
    struct Pass {
        std::string name;
        std::vector<double> gpu_ms, cpu_ms;
    };
    std::vector<double> total_ms;     ///< sum over all passes
    std::vector<double> maps_ms;      ///< sum over passes that draw or change shadow maps
    std::vector<Pass> passes;         ///< passes that ran, in the frame's order
    std::string clock;                ///< name of the clock
    std::vector<std::size_t> bursts;  ///< index of the first frame of each burst
    bool burst_ended = true;          ///< the next frame begins a new burst
    std::vector<double> wall_ms;      ///< elapsed time where the others are processor time; otherwise 0

    /// Appends the pass times of a drawn frame to the samples.
    void add(const FrameResult& frame);
    /// Appends the samples of other frames. Their bursts (runs of frames without a pause) stay separate.
    void add(const TimeSamples& more);
};

/// Statistics of one render pass's times over several frames.
struct PassTime {
    std::string name;
    Spread gpu_ms, cpu_ms;
};

/// Measured time of a frame: statistics over several frames, in milliseconds.
struct TimeMeasurement {
    Spread total_ms;                   ///< sum over all passes
    Spread maps_ms;                    ///< sum over passes that draw or change shadow maps
    Spread picture_ms;                 ///< sum over all other passes: visibility and shading
    std::optional<Spread> wall_ms;     ///< elapsed time of all passes, where the others are processor time
    std::vector<PassTime> passes;      ///< passes that ran, in the frame's order
    bool settled = false;              ///< the confidence interval is below the limit, over several bursts
    double seconds = 0;                ///< time from the first frame to the last; 0: unknown
    std::string clock;                 ///< name of the clock
    CostCase cost = CostCase::Forced;  ///< kind of frames that were timed
};

/// Returns the unit of times from a clock: "ms of processor" for processor time, else "ms".
/// @param clock name of the clock
std::string_view time_unit(const std::string& clock);

/// Limit of Spread::relative() of the total frame time, below which a timing has settled. It is half the width of the
/// median's confidence interval, as a share of the median.
inline constexpr double kSettledSpread = 0.03;
/// Smallest number of bursts (runs of frames without a pause) for a settled time. Fewer bursts do not show how bursts
/// differ.
inline constexpr int kMinBursts = 3;

/// Computes the statistics of sampled pass times.
/// @param settled_below limit of Spread::relative() below which the total frame time has settled
TimeMeasurement summarise_times(const TimeSamples& samples, double settled_below = kSettledSpread);

/// Collector of the pass times of frames under one set of settings, until their median has settled. Frames come in
/// bursts over a second or more, since a machine's speed drifts over longer times than a few frames take. Request the
/// frames by set_timed_passes(), as cached passes count as 0 ms.
class TimeSampler {
public:
    /// Limits of a timing: numbers of frames and bursts, shortest duration, and the interval at which the median has
    /// settled.
    struct Limits {
        int least = 5, most = 60;        ///< smallest and largest number of frames
        double spread = kSettledSpread;  ///< limit of Spread::relative()
        int bursts = 5;                  ///< smallest number of bursts
        double over_s = 1;               ///< shortest duration of all bursts, seconds
    };
    TimeSampler() : TimeSampler(Limits{}) {}
    /// Begins a timing of frames with these limits.
    explicit TimeSampler(const Limits& limits) : limits_(limits) {}

    /// Adds the pass times of a drawn frame to the timing. The first frame, and the first after a pause, only warms up
    /// and is not counted. @param now_s time at the frame's end in seconds, by any clock
    void add(const FrameResult& frame, double now_s);
    /// Returns the seconds to wait before the next timed frame is drawn; 0: none.
    double pause_s() const { return pause_s_; }
    /// Returns the number of counted frames.
    int frames() const { return int(samples_.total_ms.size()); }
    /// Returns true when the median frame time is precise enough: its confidence interval is below Limits::spread,
    /// after at least Limits::least frames in Limits::bursts bursts. Use done() to end a timing.
    bool settled() const;
    /// Returns true when no further frame is needed: settled, or at the limit of frames.
    bool done() const { return settled() || frames() >= limits_.most; }
    /// Returns the statistics of the pass times collected so far.
    TimeMeasurement result() const;

private:
    static constexpr int kBurstFrames = 3;

    Limits limits_;
    TimeSamples samples_;
    bool begun_ = false, warm_ = false;
    double start_s_ = 0, burst_s_ = 0, last_s_ = 0;  ///< time of the first frame, the burst's start, the last frame
    double pause_s_ = 0;
    int ended_ = 0, in_burst_ = 0;  ///< ended bursts; frames of the present burst
};

/// Clock for timing frames in bursts: the present time, and a function that waits. Tests replace both.
struct BurstClock {
    std::function<double()> now_s;       ///< present time, seconds
    std::function<void(double)> wait_s;  ///< waits for a number of seconds
    /// Makes a clock that reads the machine's monotonic clock and waits by sleeping.
    static BurstClock steady();
};

/// Times frames in bursts (runs without a pause) until the median time is precise enough or the limit of frames is
/// reached. An exception from `draw` ends the timing and reaches the caller.
/// @param draw a function that draws one frame with timed passes
/// @param clock clock of the bursts; tests pass their own
TimeMeasurement sample_times(const TimeSampler::Limits& limits, const std::function<FrameResult()>& draw,
                             const BurstClock& clock = BurstClock::steady());

/// Work of a frame in numbers that do not depend on the machine: texels, bytes, draw calls, triangles.
struct WorkCost {
    double taps_per_pixel = 0;     ///< texels that the kernel fetches per light and lit pixel; 0: no light has a map
    std::uint64_t map_texels = 0;  ///< texels of all shadow maps
    std::uint64_t map_bytes = 0;   ///< bytes of shadow maps, copies for map.blur_texels, and light maps
    /// Bytes of maps plus bytes of look-ups, as if each pixel were lit by each casting light.
    std::uint64_t bytes_touched = 0;
    std::uint64_t draws = 0, triangles = 0;  ///< sums over all passes that ran
};

/// Computes the work of a frame in numbers that do not depend on the machine: texels, bytes, draw calls, triangles.
/// @param frame a frame drawn with FrameRequest::force, so that every pass counts
WorkCost work_cost(const Settings& settings, const FrameResult& frame);

}  // namespace si
