// Options and function of the command `check`.
#pragma once

#include <optional>
#include <string>

#include "app/commands/commands.h"

namespace si {

/// Options of the command `check`, which compares shadow errors with limits. The scene may be a RenderDoc capture.
/// Empty texts stand for options that are not given.
struct CheckOptions : CommandOptions {
    std::string max_acne, max_wrong, tolerance;  ///< limits on pixels, parse_pixel_limit()
    std::optional<double> max_error;
    std::string error;                     ///< error that max_error limits, one of checked_errors(); empty: the first
    std::string baseline, write_baseline;  ///< files of baselines to compare with and to write
    std::string junit;                     ///< JUnit report to write
};

/// Runs the command `check`: measures the shadow errors of the light that view.light selects, and compares them with
/// the limits of the options. The errors are those that `measure` prints.
/// @throws LimitExceeded if an error exceeds its limit @throws Error if the picture cannot be checked
void run_check(const CheckOptions& options);

}  // namespace si
