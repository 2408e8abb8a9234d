// Checks over whole arrays of floats that a compiler turns into wide integer instructions; sums or comparisons of
// floats it must leave in order.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace si {

/// Bits of the greatest magnitude among the components. Magnitudes are ordered as their bits are, with infinity above
/// all numbers and NaN above infinity.
template <class Vec>
std::uint32_t greatest_magnitude_bits(const std::vector<Vec>& values) {
    const auto* components = reinterpret_cast<const float*>(values.data());
    std::int32_t greatest = 0;
    for (std::size_t i = 0; i < values.size() * std::size_t(Vec::length()); ++i) {
        const auto bits = std::int32_t(std::bit_cast<std::uint32_t>(components[i]) & 0x7fffffffu);
        greatest = std::max(greatest, bits);
    }
    return std::uint32_t(greatest);
}

/// Whether every component is a number of at most this magnitude.
template <class Vec>
bool all_within(const std::vector<Vec>& values, float magnitude) {
    return greatest_magnitude_bits(values) <= std::bit_cast<std::uint32_t>(magnitude);
}

template <class Vec>
bool all_finite(const std::vector<Vec>& values) {
    return all_within(values, std::numeric_limits<float>::max());
}

}  // namespace si
