// Upper bound of visibility by a kernel that reads moments, written out as its shader evaluates it.
#pragma once

#include <limits>
#include <string>

#include "renderer/inspect/probe.h"
#include "renderer/settings/filters.h"

namespace si {

/// Evaluated bound of a moment kernel, with the clamp that decides it.
struct MomentBound {
    std::string formula;  ///< with its numbers: "v / (v + (z - m)^2) with v 0.00121, z - m 0.0233"
    std::string clamp;    ///< the clamp that decides, a clause; empty: none does
    /// Standard deviation of depths that filter.min_variance stands for, as a share of the map's range, where it is
    /// larger than that of the moments; else NaN.
    double floor_spread = std::numeric_limits<double>::quiet_NaN();
};

/// Evaluates the bound of the lit share that a moment kernel computes from the moments that it read. Gives the formula
/// of its BoundRule with the parameter values in effect, after all clamps.
/// @param row the kernel's row @param facts facts with a known `bound`
MomentBound moment_bound(const Filter& row, const FilterSettings& settings, const KernelFacts& facts);

}  // namespace si
