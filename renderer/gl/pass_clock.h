// Timing of passes. On a GPU, timer queries are exact; a CPU rasteriser defers work past the queries, so wall time up
// to glFinish() is used there. A calibration once per context chooses between the two.
#pragma once

#include <array>
#include <chrono>
#include <string>
#include <vector>

#include "renderer/gl/handle.h"

namespace si::gl {

/// Stopwatch for render passes, by OpenGL timer queries or by wall time, whichever is right for the driver.
class PassClock {
public:
    /// Calibrates with a known pass: queries are used when they report 0.5 to 2 times its wall time.
    PassClock();
    /// Returns true when passes are timed by queries, false for wall time.
    bool uses_queries() const { return uses_queries_; }
    /// Returns query time over wall time of the calibration pass.
    double query_share() const { return query_share_; }
    /// Returns the name of the clock that times passes (queries or wall time), for reports.
    std::string name() const;

    /// Starts timing a render pass; end() stops it.
    void begin();
    /// Stops timing the render pass begun last. Returns its slot for milliseconds().
    std::size_t end();
    /// Returns the time of a pass in milliseconds. Waits for the GPU when queries are used.
    /// @param slot the slot that end() returned
    double milliseconds(std::size_t slot);
    /// Makes all measured slots reusable. Call before the first pass of a frame.
    void reset() { used_ = 0; }

private:
    bool uses_queries_ = true;
    double query_share_ = 0;
    /// Queries or wall time of one timed pass.
    struct Slot {
        Query start, stop;
        double wall_ms = 0;
    };
    std::vector<Slot> slots_;
    std::size_t used_ = 0;
    std::chrono::steady_clock::time_point started_;
};

}  // namespace si::gl
