// Depth bias that a whole frame needs, by theory: the start of every search for the least bias.
#pragma once

#include <optional>

#include "renderer/bias/account.h"
#include "renderer/measure/frontier.h"
#include "renderer/measure/measured_error.h"
#include "renderer/settings/biases.h"

namespace si {

/// Pixels of a frame that lack bias, and side effects of the bias that it has.
struct BiasNeeds {
    std::size_t pixels = 0;  ///< number of pixels that are lit in the reference and covered by the map
    /// Number of faintly darkened pixels, half lit or more, on planes with less bias than they need.
    std::size_t faint_acne = 0;
    /// Number of faintly darkened pixels on planes with enough bias: an adjoining surface rises within the kernel's
    /// reach, as a wall above its floor.
    std::size_t folds = 0;
    /// Width of the lit gap at casters that touch their receiver, under the present bias, metres.
    double gap_median_m = 0, gap_p95_m = 0;
    /// Shift of shadow edges along the surface by the normal offset, h tan(theta), 95th percentile, metres.
    double shift_p95_m = 0;
};

/// Computes which pixels of a measured frame lack bias, over pixels that are counted, lit in the reference and covered
/// by the map. Only these can show acne. Widths come from an even sample of them.
/// @param settings settings of the measured frame
BiasNeeds bias_needs(const MeasuredError& measured, const Settings& settings, const RasterTraits& driver);

/// Returns true when some pixel is counted, lit in the reference and covered by the map.
bool has_lit_receivers(const MeasuredError& measured);

/// Returns the distance of a point from the camera along its axis, metres.
double depth_along_axis_m(const Camera& camera, const glm::dvec3& position_ws);
/// Returns the width of a pixel at a depth along the camera's axis, metres. @param lines height of the picture in
/// pixels
double pixel_m(const Camera& camera, double depth_m, int lines);

/// Computes the bias terms of one receiver of a measured frame under given settings, and the bias that it needs.
BiasBreakdown measured_bias_breakdown(const MeasuredError& measured, const Settings& settings, const Receiver& receiver,
                                      const RasterTraits& driver);

/// Computes the least settings of one row of the bias table under which 999 of 1000 pixels of bias_needs() have enough
/// bias, from an even sample of them. Amounts are in texels where they count in bias.unit. Rows that compute the needed
/// bias by themselves get no amounts. Rows that act beside bias.kind are taken alone.
/// Amounts end at the limits of the settings.
/// @return none when no amount of the row has an effect where bias is needed
std::optional<BiasSettings> least_bias_of_row(const Bias& row, const MeasuredError& measured, const Settings& settings,
                                              const RasterTraits& driver);

/// Multiplies all amounts of bias by a factor and clamps them to the limits of the settings.
BiasSettings scale_bias(const BiasSettings& bias, double factor);

}  // namespace si
