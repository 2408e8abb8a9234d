// Options and function of the command `check`.
#pragma once

#include <optional>
#include <string>

#include "app/commands/commands.h"

namespace si {

/// Options of the command `check`. The scene may be a RenderDoc capture. Empty texts: not given.
struct CheckOptions : CommandOptions {
    std::string max_acne, max_wrong, tolerance;  ///< limits on pixels, parse_pixel_limit()
    std::optional<double> max_error;
    std::string error;                     ///< error that max_error limits, one of checked_errors(); empty: the first
    std::string baseline, write_baseline;  ///< files of baselines to compare with and to write
    std::string junit;                     ///< JUnit report to write
};

/// Runs the command `check`: measures the error of the shadows of view.light as `measure` does, and compares it with
/// limits. @throws LimitExceeded where a limit is exceeded @throws Error where the picture cannot be checked
void run_check(const CheckOptions& options);

}  // namespace si
