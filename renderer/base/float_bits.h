// Checks over whole arrays of floats, done on their bits: a compiler vectorises integer code, but may not reorder
// operations on floats.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace si {

/// Returns the bit pattern of the largest absolute value among all components of `values` (glm float vectors). Bit
/// patterns of magnitudes are ordered as the magnitudes are, with infinity above all numbers and NaN above infinity.
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

/// Returns true when every component of `values` is a number with an absolute value of at most `magnitude`.
template <class Vec>
bool all_within(const std::vector<Vec>& values, float magnitude) {
    return greatest_magnitude_bits(values) <= std::bit_cast<std::uint32_t>(magnitude);
}

/// Returns true when no component of `values` is NaN or infinite.
template <class Vec>
bool all_finite(const std::vector<Vec>& values) {
    return all_within(values, std::numeric_limits<float>::max());
}

}  // namespace si
