// Fallbacks for numbers that are not finite or not positive.
#pragma once

#include <cmath>

namespace si {

/// Returns `value`, or `fallback` when `value` is NaN or infinite.
inline double finite_or(double value, double fallback) {
    return std::isfinite(value) ? value : fallback;
}
/// Returns `value`, or `fallback` when `value` is NaN, infinite, zero or negative.
inline double positive_or(double value, double fallback) {
    return std::isfinite(value) && value > 0 ? value : fallback;
}

}  // namespace si
