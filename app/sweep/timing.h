// How a sweep takes times.
#pragma once

#include "renderer/measure/frame_costs.h"

namespace si {

/// Rounds go on until every case's time has settled (time_sampler.h), or the most rounds were drawn.
struct SweepTiming {
    bool on = true;
    CostCase cost = kDefaultCost;  ///< of which frames
    int rounds = 10;               ///< at most
    int frames = 3;                ///< a case draws in a round, after one that warms up
    int least_frames = 5;          ///< a case draws over all rounds before it may have settled
};

}  // namespace si
