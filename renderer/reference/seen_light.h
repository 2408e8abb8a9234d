// Grid over an area light of what one surface point sees, sampled more finely along the edges of shadows. Internal to
// this folder.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/reference/emitter.h"

namespace si {

/// Result of tracing a shadow ray from a surface point to a sample point on a light.
enum class Seen : std::uint8_t {
    Below,  ///< below the surface's horizon
    Dark,
    Lit
};

/// Estimate of the visible share of an area light from samples, with its standard error (NaN: unknown).
struct Estimate {
    double visibility = 1, error = 0;
    std::size_t samples = 0, rays = 0;
};

/// Area light as one surface point sees it, for estimating its visible share with few rays: a grid of 2^n equal cells.
/// A cell has the state of its own sample point: lit, dark, or below the surface's horizon. A cell without a sample
/// takes the state of the larger cell from which it was halved; all neighbours of the larger cell then had the same
/// state. Therefore the number of samples grows with the length of the shadow's edge on the light, not with the light's
/// area. Where shadows seem narrower than cells, all cells are sampled.
class SeenLight {
public:
    /// Starts the grid of cells over the area light with the results of the first shadow rays.
    /// @param samples sample points on the light
    /// @param seen results for the first sample points, at least one
    void start(const LightSamples& samples, std::span<const Seen> seen);

    /// Halves all cells of the grid over the area light. Returns the sample points to trace next, whose results
    /// set_wanted() takes. They lie in halves of cells whose state (lit, dark, below the horizon) differed from a
    /// neighbour's. If shadows seem narrower than cells, they lie in all cells. The span stays valid until the next
    /// call.
    /// @param end sample points from this index on are not used
    /// @param everywhere true: returns the sample points of all cells
    std::span<const std::uint32_t> halve(const LightSamples& samples, std::uint32_t end, bool everywhere);
    /// Stores the traced results of the sample points on the light that halve() returned.
    void set_wanted(std::span<const Seen> seen);

    /// Returns the number of samples that the current grid over the area light would have if every cell were sampled.
    std::uint32_t fineness() const { return fineness_; }

    /// Estimates the visible share of the light from all samples so far. Only the part of the light above the surface's
    /// horizon counts.
    /// @param hard visibility to return when no sample lies above the horizon
    Estimate estimate(double hard) const;

private:
    /// Set of bits, one for each cell of the grid over the area light. Each row of cells begins with a new word.
    using Bits = std::vector<std::uint64_t>;

    int digits_ = 0;  ///< the grid has 2^digits_ cells
    std::uint32_t fineness_ = 0;
    std::size_t taken_ = 0;              ///< number of samples
    std::vector<std::uint32_t> point_;   ///< by cell: index of the sample point in the cell
    std::vector<std::uint8_t> sampled_;  ///< by sample point: 1 if it was traced, else 0
    Bits lit_, above_;
    Bits to_halve_, differ_, scratch_;
    std::vector<std::uint32_t> wanted_, wanted_cells_;  ///< sample points to trace, and their cells

    std::size_t across() const { return std::size_t{1} << (digits_ + 1) / 2; }
    std::size_t words_per_row() const { return (across() + 63) / 64; }
    std::size_t words() const { return words_per_row() << digits_ / 2; }
    std::uint64_t columns() const { return ~std::uint64_t{0} >> (63 - (across() - 1) % 64); }
    /// Place of a cell (of the grid over an area light) in a set of bits: index of the word, and a mask with the cell's
    /// bit.
    struct BitPlace {
        std::size_t word;
        std::uint64_t bit;
    };
    /// Returns the place of a cell of the grid over the area light in a set of bits: index of the word, and mask of the
    /// bit.
    BitPlace place_of(std::size_t cell) const;
    /// Returns the index of the word with the bits of the cells one row above, in the grid over the area light. For the
    /// first row returns `word` itself.
    /// @param word index of a word in a set of bits, one bit a cell
    std::size_t row_above(std::size_t word) const;
    /// Returns the index of the word with the bits of the cells one row below, in the grid over the area light. For the
    /// last row returns `word` itself.
    /// @param word index of a word in a set of bits, one bit a cell
    std::size_t row_below(std::size_t word) const;
    /// Returns the bits of the left neighbours of the cells of one word: up to 64 cells in a row of the grid over the
    /// area light. A cell at the grid's border gets its own bit in place of a neighbour's.
    /// @param bits one bit for each cell of the grid
    /// @param word index of the word
    std::uint64_t left(const Bits& bits, std::size_t word) const;
    /// Returns the bits of the right neighbours of the cells of one word: up to 64 cells in a row of the grid over the
    /// area light. A cell at the grid's border gets its own bit in place of a neighbour's.
    /// @param bits one bit for each cell of the grid
    /// @param word index of the word
    std::uint64_t right(const Bits& bits, std::size_t word) const;
    /// Returns the other half of the larger cell from which a cell of the grid over the area light was halved.
    std::size_t other_half(std::size_t cell) const;
    /// Stores the state of a cell of the grid over the area light: lit, dark, or below the surface's horizon.
    void set(std::size_t cell, Seen seen);
    /// Converts a set of bits, one for each cell of the grid over the area light, to the grid with halved cells. Both
    /// halves of a cell get the cell's bit.
    void double_cells(Bits& bits);
    /// Marks the cells of the grid over the area light whose state (lit, dark, below the horizon) differs from that of
    /// one of their eight neighbours. Halves of marked cells are sampled.
    void find_differing();
    /// Returns true when shadows on the light, or gaps between them, seem narrower than cells. Either several cells
    /// differ in state (lit, dark, below the horizon) from all four neighbours, or most cells of the rarer state lie in
    /// no 2x2 square of that state.
    bool has_narrow_shadows();
    /// Returns the set of cells, in the grid over the area light, above the surface's horizon. Cells that have no
    /// sample, since the limit of sample points (fineness()) was reached, are left out.
    Bits own_samples() const;
};

}  // namespace si
