// Median of measured values.
#pragma once

#include <algorithm>
#include <vector>

namespace si {

/// Returns the median of `v`, the upper one of two. @param v not empty
inline double median(std::vector<double> v) {
    std::sort(v.begin(), v.end());
    return v[v.size() / 2];
}

}  // namespace si
