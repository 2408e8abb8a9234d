// Sweep along a light's path: `sweep --along` and `sweep --day`.
#pragma once

#include <string>

#include "app/commands/commands.h"
#include "renderer/measure/light_path.h"

namespace si {

/// Options of the command `sweep`, with those of the path along which a light moves. Empty texts stand for options that
/// are not given.
struct PathSweepOptions : SweepOptions {
    std::string along;         ///< straight_path()
    std::string day;           ///< day_path()
    int steps = kPathSteps;    ///< number of points
    std::string error;         ///< error whose largest value is the worst step, one of tuned_errors()
    std::string worst_preset;  ///< preset to write with the settings of the worst step, .json
    /// Returns true if a path is given.
    bool has_path() const { return !along.empty() || !day.empty(); }
};

/// Runs the command `sweep`: over combinations of settings (run_sweep()), or along a path of a light. Along a path it
/// measures every step and writes path.json, path.csv and path.html into the output folder.
/// @throws UsageError, Error
void run_path_sweep(const PathSweepOptions& options);

}  // namespace si
