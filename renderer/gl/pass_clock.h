// Timing of passes. A GPU has timer queries. A driver that draws on the CPU is timed by the processor time of its
// threads up to glFinish(), which other work of the machine does not change. A calibration once per context finds those
// threads.
#pragma once

#include <array>
#include <chrono>
#include <string_view>
#include <vector>

#include "renderer/base/processor_time.h"
#include "renderer/gl/handle.h"

namespace si::gl {

/// Way in which a PassClock measures the time of a render pass.
enum class ClockKind {
    Queries,    ///< OpenGL timer queries
    Processor,  ///< processor time of the drawing thread and the driver's workers
    Wall,       ///< elapsed time
};

/// Returns the name of a kind of clock for reports, such as "GPU timer queries".
std::string_view name(ClockKind kind);

/// Stopwatch for render passes of the current OpenGL context, used on one thread.
class PassClock {
public:
    /// Draws a test pass to choose the kind of clock. A CPU rasteriser gets Processor. Otherwise Queries is chosen if
    /// the query time of the pass is 0.5 to 2 times its wall time, else Wall.
    /// @param cpu_rasteriser true: the driver draws on the CPU
    explicit PassClock(bool cpu_rasteriser);
    /// Returns the way in which passes are timed.
    ClockKind kind() const { return kind_; }
    /// Returns the timer-query time divided by the wall time, measured for the pass that the constructor draws.
    double query_share() const { return query_share_; }

    /// Starts timing a render pass; end() stops it.
    void begin();
    /// Stops timing the render pass begun last. Returns the pass's slot, by which milliseconds() gives its time.
    std::size_t end();
    /// Returns the measured time of a render pass in milliseconds, by the clock's kind. Waits for the GPU when timer
    /// queries are used.
    /// @param slot slot that end() returned
    double milliseconds(std::size_t slot);
    /// Returns the elapsed time of a render pass in milliseconds, until the GPU has finished it; 0 when queries are
    /// used.
    /// @param slot slot that end() returned
    double wall_ms(std::size_t slot) const { return slots_[slot].wall_ms; }
    /// Discards the times of all timed passes. Call before the first pass of a frame.
    void reset() { used_ = 0; }

private:
    ClockKind kind_ = ClockKind::Queries;
    double query_share_ = 0;
    std::vector<ThreadId> workers_;  ///< the driver's own threads that draw
    /// Timer queries or measured times of one render pass.
    struct Slot {
        Query start, stop;
        double processor_ms = 0, wall_ms = 0;
    };
    /// Returns the processor time in milliseconds that this thread and the driver's worker threads have used so far.
    double drawing_ms() const;

    std::vector<Slot> slots_;
    std::size_t used_ = 0;
    std::chrono::steady_clock::time_point started_;
    double started_processor_ms_ = 0;
};

}  // namespace si::gl
