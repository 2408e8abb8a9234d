// Median of measured values.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace si {

/// Returns the median of `v`; for an even count, the larger of the two middle values. @param v not empty
inline double median(std::vector<double> v) {
    const auto middle = v.begin() + std::ptrdiff_t(v.size() / 2);
    std::nth_element(v.begin(), middle, v.end());
    return *middle;
}

}  // namespace si
