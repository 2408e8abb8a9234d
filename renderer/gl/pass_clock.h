// The clock of a pass. On a GPU timer queries tell the truth; on a CPU rasteriser the work is deferred past them, so
// finished wall time is used there. Which holds is measured once per context.
#pragma once

#include <array>
#include <chrono>
#include <string>
#include <vector>

#include "renderer/gl/handle.h"

namespace si::gl {

class PassClock {
public:
    /// Measures a known pass both ways. Queries are used when they report 0.5 to 2 times its finished wall time.
    PassClock();
    bool uses_queries() const { return uses_queries_; }
    double query_share() const { return query_share_; }  ///< query / wall time of the known pass
    std::string name() const;

    void begin();
    /// Ends the pass begun last; returns its slot.
    std::size_t end();
    /// Milliseconds of a slot. Waits for the GPU when queries are used.
    double milliseconds(std::size_t slot);
    void reset() { used_ = 0; }

private:
    bool uses_queries_ = true;
    double query_share_ = 0;
    struct Slot {
        Query start, stop;
        double wall_ms = 0;
    };
    std::vector<Slot> slots_;
    std::size_t used_ = 0;
    std::chrono::steady_clock::time_point started_;
};

}  // namespace si::gl
