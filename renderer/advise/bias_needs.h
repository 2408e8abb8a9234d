// How much bias a whole frame needs, by theory: the start of every search for the least bias.
#pragma once

#include <optional>

#include "renderer/bias/account.h"
#include "renderer/measure/frontier.h"
#include "renderer/measure/measured_error.h"
#include "renderer/settings/biases.h"

namespace si {

/// A way to spend bias. Each leaves the others at nothing but a small constant for what grows with no slope.
enum class BiasFamily {
    Constant,  ///< bias.constant alone
    Slope,     ///< bias.slope over a constant, the pair that costs least
    Normal,    ///< bias.normal over a constant for the format's steps
};
inline constexpr std::size_t kBiasFamilies = 3;
std::string_view family_label(BiasFamily family);

struct BiasNeeds {
    std::size_t pixels = 0;  ///< that the light reaches, inside the map
    /// Of them those that more bias lights wholly. Faint: half lit or more, on planes that have less bias than they
    /// need. Folds: the plane has all that it needs, so what darkens it rises beside it, as a wall does above the floor
    /// that it stands on.
    std::size_t faint_acne = 0, folds = 0;
    /// The least setting of each family that clears every one of these pixels' planes, in texels.
    std::array<BiasSettings, kBiasFamilies> least{};
    /// What the present bias costs: metres of lit ground beside a caster that touches its receiver, over these pixels.
    double gap_median_m = 0, gap_p95_m = 0;
    /// How far the normal offset moves a shadow's edges along the surface, h tan(theta), for 95 % of these pixels.
    double shift_p95_m = 0;
    const BiasSettings& of(BiasFamily family) const { return least[std::size_t(family)]; }
};

/// Over the pixels that count, are lit in truth and lie in the map: only these can show acne.
/// @param settings that were measured
BiasNeeds bias_needs(const MeasuredError& measured, const Settings& settings, const RasterTraits& driver);

/// What of bias a receiver of the picture that was measured gets and needs under the settings.
BiasBreakdown measured_bias_breakdown(const MeasuredError& measured, const Settings& settings, const Receiver& receiver,
                                      const RasterTraits& driver);

/// The row that a family spends.
const Bias& row_of(BiasFamily family);

/// The least settings under which a row clears 999 of 1000 of the pixels of bias_needs() by its own account, in texels
/// where it counts in bias.unit: those settings of the row that are worth anything, the last of them for what grows
/// with no slope. A row that needs no numbers gets none; nothing where the settings' limits do not let it.
std::optional<BiasSettings> least_bias_of_row(const Bias& row, const MeasuredError& measured, const Settings& settings,
                                              const RasterTraits& driver);

/// Every amount times `factor`, within what the settings allow.
BiasSettings scaled(const BiasSettings& bias, double factor);

}  // namespace si
