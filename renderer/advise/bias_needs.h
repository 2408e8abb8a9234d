// Depth bias that a whole frame needs, by theory: the start of every search for the least bias.
#pragma once

#include <optional>

#include "renderer/bias/account.h"
#include "renderer/measure/frontier.h"
#include "renderer/measure/measured_error.h"
#include "renderer/settings/biases.h"

namespace si {

/// Combination of bias settings in which a search looks for the least bias: a constant alone, or a small constant with
/// slope bias or normal offset.
enum class BiasFamily {
    Constant,  ///< bias.constant alone
    Slope,     ///< bias.slope over a constant, the pair with the smallest gap at casters
    Normal,    ///< bias.normal over a constant for the format's depth steps
};
inline constexpr std::size_t kBiasFamilies = 3;
/// Returns the name of a bias family for people and JSON: "constant bias", "slope bias" or "normal offset".
std::string_view family_label(BiasFamily family);

/// Depth bias that the lit pixels of a frame need, by theory, and side effects of the present bias.
struct BiasNeeds {
    std::size_t pixels = 0;  ///< number of pixels that are lit in the reference and covered by the map
    /// Number of faintly darkened pixels, half lit or more, on planes with less bias than they need.
    std::size_t faint_acne = 0;
    /// Number of faintly darkened pixels on planes with enough bias: an adjoining surface rises within the kernel's
    /// reach, as a wall above its floor.
    std::size_t folds = 0;
    /// Least bias of each family under which no pixel's plane shadows itself, in texels.
    std::array<BiasSettings, kBiasFamilies> least{};
    /// Width of the lit gap at casters that touch their receiver, under the present bias, metres.
    double gap_median_m = 0, gap_p95_m = 0;
    /// Shift of shadow edges along the surface by the normal offset, h tan(theta), 95th percentile, metres.
    double shift_p95_m = 0;
    /// Returns the least bias of a family under which no pixel's plane shadows itself.
    const BiasSettings& least_of(BiasFamily family) const { return least[std::size_t(family)]; }
};

/// Computes the depth bias that a measured frame needs, over pixels that are counted, lit in the reference and covered
/// by the map. Only these can show acne.
/// @param settings settings of the measured frame
BiasNeeds bias_needs(const MeasuredError& measured, const Settings& settings, const RasterTraits& driver);

/// Computes the bias terms of one receiver of a measured frame under given settings, and the bias that it needs.
BiasBreakdown measured_bias_breakdown(const MeasuredError& measured, const Settings& settings, const Receiver& receiver,
                                      const RasterTraits& driver);

/// Returns the row of the bias table whose settings a bias family uses.
const Bias& family_row(BiasFamily family);

/// Computes the least settings of one row of the bias table under which 999 of 1000 pixels of bias_needs() have enough
/// bias. Amounts are in texels where they count in bias.unit. A row without amounts gets none.
/// @return none when the limits of the settings do not allow enough bias
std::optional<BiasSettings> least_bias_of_row(const Bias& row, const MeasuredError& measured, const Settings& settings,
                                              const RasterTraits& driver);

/// Multiplies constant, slope and normal bias by a factor and clamps them to the limits of the settings.
BiasSettings scale_bias(const BiasSettings& bias, double factor);

}  // namespace si
