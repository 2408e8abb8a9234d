// Options for timing the cases of a sweep.
#pragma once

#include "renderer/measure/frame_costs.h"

namespace si {

/// Timing options of a sweep. Rounds go on until every case's time has settled (time_sampler.h), up to a limit.
struct SweepTiming {
    bool on = true;
    CostCase cost = kDefaultCost;  ///< kind of frames to time
    int rounds = 10;               ///< largest number of rounds
    int frames = 3;                ///< timed frames per case and round, after one warm-up frame
    int min_frames = 5;            ///< smallest number of frames of a case before its time can count as settled
};

}  // namespace si
