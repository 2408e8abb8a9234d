// Tuning: the least bias of a frame and, with limits of error or time, the kernel and resolution that keep them.
#pragma once

#include <optional>
#include <string>

#include "renderer/advise/autopilot.h"
#include "renderer/advise/least_bias.h"

namespace si {

/// Goals of tune(): limits of error, frame time and lit gap at casters that bias, kernel and map resolution have to
/// keep.
struct TuneGoals {
    std::optional<double> max_error, max_ms;   ///< limits; if both are none, only bias is searched
    const Metric* error = &metrics().front();  ///< metric of max_error; not Better::Neither
    CostCase cost = kDefaultCost;              ///< kind of frames that are timed for max_ms
    bool no_acne = false;                      ///< true: only biases without acne are allowed
    std::optional<double> max_gap_m;           ///< largest gap at casters, metres
    /// Returns true when there is a limit of error or time.
    bool any() const { return max_error || max_ms; }
};

/// Result of tune(): the least bias and, if error or time was limited, the best kernel and map resolution within the
/// limits.
struct Tuned {
    FoundBias bias;
    std::optional<AutopilotResult> limits;  ///< tried kernels and resolutions; none: no limit of error or time
    std::optional<Settings> result;         ///< settings with the bias, kernel and resolution found; none: none found
    std::string summary;                    ///< the settings and their cost in a sentence, or why there are none
};

/// Searches the least bias of the light that view.light selects. If error or time is limited, then searches the best
/// kernel and map resolution under this bias.
/// @param shown receives the biases so far
/// @throws Cancelled before the first result; Error when the light draws no map
Tuned tune(const SearchTools& tools, const Settings& settings, const TuneGoals& goals,
           const FoundBiasShown& shown = {});

/// Replaces bias, kernel and map resolution in `settings` by those of `found`, the result of tune().
void apply_tuning(Settings& settings, const Settings& found);

}  // namespace si
