// Sweep along a light's path: `sweep --along` and `sweep --day`.
#pragma once

#include <string>

#include "app/commands/commands.h"
#include "renderer/measure/light_path.h"

namespace si {

/// Options of the command `sweep`, also for a path along which a light moves. Empty texts stand for options that are
/// not given.
struct PathSweepOptions : SweepOptions {
    std::string along;         ///< path of straight_path()
    std::string day;           ///< path of day_path()
    int steps = kPathSteps;    ///< number of points
    std::string error;         ///< error whose largest value marks the worst step, one of tuned_errors()
    std::string worst_preset;  ///< preset to write with the settings of the worst step, .json
    /// Returns true if the options give a path of a light (--along or --day).
    bool has_path() const { return !along.empty() || !day.empty(); }
};

/// Runs the command `sweep`: measures combinations of settings (run_sweep()), or the steps of a path along which a
/// light moves. A path's results go into path.json, path.csv and path.html in the output folder.
/// @throws UsageError, Error
void run_path_sweep(const PathSweepOptions& options);

}  // namespace si
