// Which of a frame's numbers are none, or lie where none can: counted and located.
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

enum class NumberFault {
    NotANumber,
    Infinite,
    OutsideRange,      ///< a depth or a share of light beyond 0 to 1
    NegativeVariance,  ///< of stored moments, by more than they are rounded by
    Overflow,          ///< a power of e beyond what its format holds, or flushed to zero
};
inline constexpr std::size_t kNumberFaults = 5;

/// As JSON names it: "nan", "negative_variance".
std::string_view fault_key(NumberFault fault);
/// For people: "NaN", "a variance below 0".
std::string_view fault_label(NumberFault fault);

/// One kind of fault in one image (a layer at one mip level), or in one matrix or block.
struct NumberFinding {
    NumberFault fault = NumberFault::NotANumber;
    std::optional<Result> image;  ///< nothing: of a matrix or block
    std::string place;            ///< in words: "shadow map, cascade 2 of light 0"
    int light = -1, view = -1;    ///< whose; -1: nobody's
    int level = 0;                ///< mip level
    std::uint64_t count = 0;      ///< texels, pixels or numbers
    /// Texels of maps count from the lower left, as the map viewer has them, pixels from the upper left. Of a matrix
    /// column and row. `first` in that order, row by row.
    glm::ivec2 first{0}, worst{0};
    double value = 0;  ///< at the worst: as stored, a variance, a depth
    std::string unit;  ///< "texel", "pixel", "number"
};

struct NumericHealth {
    std::vector<NumberFinding> findings;
    std::size_t images = 0;     ///< layers and mip levels that were searched
    std::uint64_t numbers = 0;  ///< texels of them
    bool sound() const { return findings.empty(); }
};

/// "NaN in 3 texels of the shadow map, cascade 2 of light 0: first at texel 12, 40".
std::string finding_text(const NumberFinding& finding);
/// In one line all that was found, the first few with their places; what was searched where all is sound.
std::string health_text(const NumericHealth& health);

}  // namespace si
