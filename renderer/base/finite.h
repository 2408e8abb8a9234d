// Numbers in place of those that cannot be used.
#pragma once

#include <cmath>

namespace si {

inline double finite_or(double value, double fallback) {
    return std::isfinite(value) ? value : fallback;
}
inline double positive_or(double value, double fallback) {
    return std::isfinite(value) && value > 0 ? value : fallback;
}

}  // namespace si
