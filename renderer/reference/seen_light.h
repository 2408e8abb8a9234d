// Grid over an area light of what one surface point sees, sampled more finely along the edges of shadows. Internal to
// this folder.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/reference/emitter.h"

namespace si {

/// State of a sample point on a light, as seen from a surface point.
enum class Seen : std::uint8_t {
    Below,  ///< below the surface's horizon
    Dark,
    Lit
};

/// Estimated visible share of a light, and its standard error; NaN: unknown.
struct Estimate {
    double visibility = 1, error = 0;
    std::size_t samples = 0, rays = 0;
};

/// Light as one surface point sees it: a grid of 2^n equal cells. A cell has the state of its own sample point. A cell
/// without a sample has the state of the larger cell that was halved, if all neighbours of that cell had it, too. So
/// the samples that a finer grid takes grow with the length of the shadow's edge on the light, not with its area. Where
/// shadows seem narrower than cells, all cells are sampled.
class SeenLight {
public:
    /// Starts with the states of the first sample points, at least one.
    void start(const LightSamples& samples, std::span<const Seen> seen);

    /// Halves the cells. Returns the sample points to trace before set_wanted(): those of both halves of each cell that
    /// differs from a neighbour. They stay valid until the next call.
    /// @param end sample points from this one on are not used @param everywhere samples all halves
    std::span<const std::uint32_t> halve(const LightSamples& samples, std::uint32_t end, bool everywhere);
    /// Sets the states of the sample points that halve() returned.
    void set_wanted(std::span<const Seen> seen);

    /// Returns the number of samples that a grid of this size takes when every cell is sampled.
    std::uint32_t fineness() const { return fineness_; }

    /// Estimates the visible share of the light's part above the surface's horizon.
    /// @param hard share when nothing of it is above the horizon
    Estimate estimate(double hard) const;

private:
    /// A bit for each cell of the grid. Rows start at words.
    using Bits = std::vector<std::uint64_t>;

    int digits_ = 0;  ///< the grid has 2^digits_ cells
    std::uint32_t fineness_ = 0;
    std::size_t taken_ = 0;              ///< number of samples
    std::vector<std::uint32_t> point_;   ///< by cell: the sample point in it
    std::vector<std::uint8_t> sampled_;  ///< by sample point: 1: traced
    Bits lit_, above_;
    Bits to_halve_, differ_, scratch_;
    std::vector<std::uint32_t> wanted_, wanted_cells_;  ///< sample points to trace, and their cells

    std::size_t across() const { return std::size_t{1} << (digits_ + 1) / 2; }
    std::size_t words_per_row() const { return (across() + 63) / 64; }
    std::size_t words() const { return words_per_row() << digits_ / 2; }
    std::uint64_t columns() const { return ~std::uint64_t{0} >> (63 - (across() - 1) % 64); }
    struct BitPlace {
        std::size_t word;
        std::uint64_t bit;
    };
    BitPlace place_of(std::size_t cell) const;
    std::size_t row_above(std::size_t word) const;
    std::size_t row_below(std::size_t word) const;
    std::uint64_t left(const Bits& bits, std::size_t word) const;
    std::uint64_t right(const Bits& bits, std::size_t word) const;
    std::size_t other_half(std::size_t cell) const;
    void set(std::size_t cell, Seen seen);
    void double_cells(Bits& bits);
    void find_differing();
    bool has_narrow_shadows();
    Bits own_samples() const;
};

}  // namespace si
