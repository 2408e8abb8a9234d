// Upper bound of visibility by a kernel that reads moments, written out as its shader evaluates it.
#pragma once

#include <limits>
#include <string>

#include "renderer/inspect/probe.h"
#include "renderer/settings/filters.h"

namespace si {

/// Upper bound of visibility that a moment kernel (VSM, ESM, EVSM, MSM) computes at one pixel. It is a formula with its
/// numbers, and the clamp that decides the result.
struct MomentBound {
    std::string formula;  ///< with its numbers: "v / (v + (z - m)^2) with v 0.00121, z - m 0.0233"
    std::string clamp;    ///< the clamp that decides, a clause; empty: none does
    /// Standard deviation of depths that filter.min_variance stands for, as a share of the map's range, where it is
    /// larger than that of the moments; else NaN.
    double floor_spread = std::numeric_limits<double>::quiet_NaN();
};

/// Writes out the upper bound of visibility that a moment kernel computes from the moments that it read. The formula is
/// that of the kernel's BoundRule, with the parameter values in effect after all clamps. Used to explain a probed
/// pixel.
/// @param row row of the kernel in the table of filters @param facts moments and depths of the pixel, with a known
/// `bound`
MomentBound moment_bound(const Filter& row, const FilterSettings& settings, const KernelFacts& facts);

}  // namespace si
