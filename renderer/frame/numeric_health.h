// Invalid numbers found in a frame, such as NaN or negative variances: kinds, counts and places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/frame/results.h"

namespace si {

/// Kind of an invalid number that a search finds in a shadow map, picture or matrix.
enum class NumberFault {
    NotANumber,
    Infinite,
    OutsideRange,      ///< depth or visibility outside 0 to 1
    NegativeVariance,  ///< negative variance of stored moments, beyond rounding
    Overflow,          ///< exponential beyond its format's range, or flushed to zero
};
/// Number of kinds of invalid numbers (NumberFault).
inline constexpr std::size_t kNumberFaults = 5;

/// Returns the JSON name of a kind of invalid number, such as "nan" or "negative_variance".
std::string_view fault_key(NumberFault fault);
/// Returns the displayed name of a kind of invalid number, such as "NaN" or "a variance below 0".
std::string_view fault_label(NumberFault fault);

/// Report on all invalid numbers of one kind, such as NaN, in one image layer, matrix or uniform block. An image is
/// searched layer by layer and mip level by mip level.
struct NumberFinding {
    NumberFault fault = NumberFault::NotANumber;
    std::optional<Result> image;  ///< result with the fault; nullopt: a matrix or block
    std::string place;            ///< in words: "shadow map, cascade 2 of light 0"
    int light = -1, view = -1;    ///< light and map view concerned; -1: none
    int level = 0;                ///< mip level
    std::uint64_t count = 0;      ///< number of faulty texels, pixels or numbers, see `unit`
    /// Position of the first and the worst fault. Map texels count from the lower left, pixels from the upper left;
    /// matrix entries are (column, row).
    glm::ivec2 first{0}, worst{0};
    double value = 0;  ///< worst value: stored number, variance or depth
    std::string unit;  ///< "texel", "pixel", "number"
};

/// Result of the search for invalid numbers (NaN, infinite, out of range) in a frame's maps, pictures and matrices.
/// `findings` is empty if none was found.
struct NumericHealth {
    std::vector<NumberFinding> findings;
    std::size_t images = 0;     ///< searched layers and mip levels
    std::uint64_t numbers = 0;  ///< searched texels
    /// Returns true when no invalid number was found.
    bool sound() const { return findings.empty(); }
};

/// Returns one sentence about invalid numbers of one kind: "NaN in 3 texels of the shadow map, cascade 2 of light 0:
/// first at texel 12, 40".
std::string finding_text(const NumberFinding& finding);
/// Returns one line about the invalid numbers (NaN, infinite, out of range) found in a frame: the first few with their
/// places. If none was found, the line says how much was searched.
std::string health_text(const NumericHealth& health);

}  // namespace si
