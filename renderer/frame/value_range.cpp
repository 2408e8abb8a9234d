#include "renderer/frame/value_range.h"

#include <algorithm>
#include <cmath>

namespace si {
namespace {

constexpr double kCutShare = 0.01;  ///< share of values cut at each end

/// Returns the value below which `share` of all values lie (nearest rank).
float percentile(std::vector<float>& values, double share) {
    const auto rank = std::ptrdiff_t(std::lround(share * double(values.size() - 1)));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[std::size_t(rank)];
}

}  // namespace

std::optional<ValueRange> fitted_range(const FloatImage& values, bool diverging) {
    std::vector<float> finite;
    for (std::size_t i = 0; i + 3 < values.data.size(); i += 4)
        if (values.data[i + 3] > 0 && std::isfinite(values.data[i])) finite.push_back(values.data[i]);
    if (finite.empty()) return std::nullopt;
    ValueRange range{percentile(finite, kCutShare), percentile(finite, 1 - kCutShare)};
    if (diverging) {
        range.max = std::max(std::abs(range.min), std::abs(range.max));
        range.min = -range.max;
    }
    const float least = std::max(1e-3f * std::max(std::abs(range.min), std::abs(range.max)), 1e-6f);
    if (range.max - range.min < least) {
        const float middle = 0.5f * (range.min + range.max);
        range = {middle - 0.5f * least, middle + 0.5f * least};
    }
    return range;
}

}  // namespace si
