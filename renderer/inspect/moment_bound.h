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
    std::string clamp;    ///< clause on the clamp that decides the result; empty: no clamp does
    /// Standard deviation sqrt(filter.min_variance), as a share of the map's depth range, where this floor replaces the
    /// variance of the moments; else NaN.
    double floor_spread = std::numeric_limits<double>::quiet_NaN();
};

/// Writes out the upper bound of visibility that a moment kernel computes from the moments that it read. The formula is
/// that of the kernel's BoundRule. Used to explain a probed pixel.
/// @param row row of the kernel in the table of filters @param settings parameter values in effect, after all clamps
/// @param facts moments and depths of the pixel, with a known `bound`
MomentBound moment_bound(const Filter& row, const FilterSettings& settings, const KernelFacts& facts);

}  // namespace si
