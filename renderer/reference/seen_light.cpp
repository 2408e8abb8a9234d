#include "renderer/reference/seen_light.h"

#include <bit>
#include <cmath>
#include <limits>

namespace si {
namespace {

constexpr std::uint64_t kEven = 0x5555555555555555;  ///< even columns

/// Returns the lower 32 bits, each repeated: abc becomes aabbcc.
std::uint64_t doubled(std::uint64_t bits) {
    bits &= 0xffffffff;
    bits = (bits | bits << 16) & 0x0000ffff0000ffff;
    bits = (bits | bits << 8) & 0x00ff00ff00ff00ff;
    bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0f;
    bits = (bits | bits << 2) & 0x3333333333333333;
    bits = (bits | bits << 1) & kEven;
    return bits | bits << 1;
}

std::size_t count(std::span<const std::uint64_t> words) {
    std::size_t out = 0;
    for (const std::uint64_t bits : words) out += std::size_t(std::popcount(bits));
    return out;
}

}  // namespace

SeenLight::BitPlace SeenLight::place_of(std::size_t cell) const {
    const std::size_t w = across(), column = cell & (w - 1);
    return {cell / w * words_per_row() + column / 64, std::uint64_t{1} << column % 64};
}

std::size_t SeenLight::other_half(std::size_t cell) const {
    return digits_ % 2 ? cell ^ 1 : cell ^ across();
}

void SeenLight::set(std::size_t cell, Seen seen) {
    const auto [word, bit] = place_of(cell);
    lit_[word] = seen == Seen::Lit ? lit_[word] | bit : lit_[word] & ~bit;
    above_[word] = seen != Seen::Below ? above_[word] | bit : above_[word] & ~bit;
}

void SeenLight::start(const LightSamples& samples, std::span<const Seen> seen) {
    digits_ = std::bit_width(seen.size() - 1);
    samples.points_in_cells(digits_, point_);
    sampled_.assign(point_.size(), 0);
    std::fill_n(sampled_.begin(), seen.size(), 1);
    lit_.resize(words());
    above_.resize(words());
    const std::size_t per_row = words_per_row(), columns = std::min<std::size_t>(across(), 64);
    for (std::size_t i = 0; i < lit_.size(); ++i) {
        const std::size_t first = i / per_row * across() + i % per_row * 64;
        std::uint64_t lit = 0, above = 0;
        for (std::size_t c = first; c < first + columns; ++c) {
            // At most one of two halves lacks a sample; it takes the other's state.
            const Seen state = seen[point_[c] < seen.size() ? point_[c] : point_[other_half(c)]];
            lit |= std::uint64_t(state == Seen::Lit) << (c - first);
            above |= std::uint64_t(state != Seen::Below) << (c - first);
        }
        lit_[i] = lit;
        above_[i] = above;
    }
    fineness_ = std::uint32_t(seen.size());
    taken_ = seen.size();
}

void SeenLight::double_cells(Bits& bits) {
    scratch_.resize(words());
    const std::size_t per_row = words_per_row();
    if (digits_ % 2 == 0) {
        for (std::size_t i = 0; i < scratch_.size(); ++i) scratch_[i] = bits[i / (2 * per_row) * per_row + i % per_row];
    } else {
        const std::size_t per_row_before = (across() / 2 + 63) / 64;
        for (std::size_t i = 0; i < scratch_.size(); ++i) {
            const std::size_t row = i / per_row, word = i % per_row;
            scratch_[i] = doubled(bits[row * per_row_before + word / 2] >> 32 * (word % 2));
        }
    }
    std::swap(bits, scratch_);
}

std::uint64_t SeenLight::left(const Bits& bits, std::size_t word) const {
    return bits[word] << 1 | (word % words_per_row() > 0 ? bits[word - 1] >> 63 : bits[word] & 1);
}

std::uint64_t SeenLight::right(const Bits& bits, std::size_t word) const {
    const bool last = word % words_per_row() + 1 == words_per_row();
    return bits[word] >> 1 | (last ? bits[word] & (columns() ^ columns() >> 1) : bits[word + 1] << 63);
}

std::size_t SeenLight::row_above(std::size_t word) const {
    return word < words_per_row() ? word : word - words_per_row();
}

std::size_t SeenLight::row_below(std::size_t word) const {
    return word + words_per_row() < words() ? word + words_per_row() : word;
}

void SeenLight::find_differing() {
    const std::size_t n = words();
    to_halve_.assign(n, 0);
    scratch_.resize(2 * n);
    for (const Bits* bits : {&lit_, &above_}) {
        for (std::size_t i = 0; i < n; ++i) {
            const std::uint64_t own = (*bits)[i], l = left(*bits, i), r = right(*bits, i);
            scratch_[2 * i] = own | l | r;
            scratch_[2 * i + 1] = own & l & r;
        }
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t up = row_above(i), down = row_below(i);
            to_halve_[i] |= (scratch_[2 * up] | scratch_[2 * i] | scratch_[2 * down]) &
                            ~(scratch_[2 * up + 1] & scratch_[2 * i + 1] & scratch_[2 * down + 1]);
        }
    }
    for (std::uint64_t& bits : to_halve_) bits &= columns();
}

bool SeenLight::has_narrow_shadows() {
    constexpr int kByChance = 2;  // isolated cells that random places of points cause without a narrow shadow
    const std::size_t n = words();
    int isolated = 0;
    for (const Bits* bits : {&lit_, &above_}) {
        for (std::size_t i = 0; i < n; ++i) {
            const std::uint64_t own = (*bits)[i], l = left(*bits, i), r = right(*bits, i);
            const std::uint64_t up = (*bits)[row_above(i)], down = (*bits)[row_below(i)];
            isolated += std::popcount(columns() & ((own & ~(l | r | up | down)) | (~own & l & r & up & down)));
        }
        const std::size_t set = count(*bits);
        const bool inverted = 2 * set > point_.size();
        const std::size_t rarer = inverted ? point_.size() - set : set;
        Bits &own = differ_, &squares = scratch_;
        own.resize(n);
        squares.resize(n);
        for (std::size_t i = 0; i < n; ++i) own[i] = inverted ? ~(*bits)[i] & columns() : (*bits)[i];
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t down = row_below(i);
            squares[i] = own[i] & right(own, i) & own[down] & right(own, down);
        }
        std::size_t outside = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t up = row_above(i);
            const std::uint64_t within = squares[i] | left(squares, i) | squares[up] | left(squares, up);
            outside += std::size_t(std::popcount(own[i] & ~within));
        }
        if (2 * outside > rarer) return true;
    }
    return isolated > kByChance;
}

std::span<const std::uint32_t> SeenLight::halve(const LightSamples& samples, std::uint32_t end, bool everywhere) {
    if (everywhere || has_narrow_shadows())
        to_halve_.assign(words(), columns());
    else
        find_differing();
    ++digits_;
    for (Bits* bits : {&lit_, &above_, &to_halve_}) double_cells(*bits);
    samples.points_in_cells(digits_, point_);
    sampled_.resize(point_.size(), 0);
    wanted_.clear();
    wanted_cells_.clear();
    const std::size_t per_row = words_per_row();
    for (std::size_t i = 0; i < to_halve_.size(); ++i) {
        const std::size_t first = i / per_row * across() + i % per_row * 64;
        for (std::uint64_t rest = to_halve_[i]; rest != 0; rest &= rest - 1) {
            const std::size_t cell = first + std::size_t(std::countr_zero(rest));
            if (sampled_[point_[cell]] || point_[cell] >= end) continue;
            wanted_.push_back(point_[cell]);
            wanted_cells_.push_back(std::uint32_t(cell));
        }
    }
    fineness_ = std::min(end, std::uint32_t(point_.size()));
    return wanted_;
}

void SeenLight::set_wanted(std::span<const Seen> seen) {
    for (const std::uint32_t point : wanted_) sampled_[point] = 1;
    for (std::size_t i = 0; i < seen.size(); ++i) set(wanted_cells_[i], seen[i]);
    taken_ += seen.size();
}

SeenLight::Bits SeenLight::own_samples() const {
    Bits out = above_;
    for (std::size_t c = 0; c < point_.size(); ++c)
        if (const auto [word, bit] = place_of(c); point_[c] >= fineness_) out[word] &= ~bit;
    return out;
}

Estimate SeenLight::estimate(double hard) const {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const std::size_t lit = count(lit_), above = count(above_);
    Estimate out{.error = kNaN, .samples = taken_};
    if (above == 0) {
        out.visibility = hard;
        return out;
    }
    out.visibility = double(lit) / double(above);
    if (fineness_ < 4) return out;
    if (lit == 0 || lit == above) {
        if (above >= 2) out.error = 0;
        return out;
    }
    // Sample variance within squares of four cells: sizes of the squares times their variances, summed.
    double sum = 0;
    std::size_t known = 0;
    const std::size_t per_row = words_per_row(), columns = across() < 64 ? across() : 64;
    const bool all_sampled = fineness_ == point_.size();
    const Bits own = all_sampled ? Bits() : own_samples();
    const Bits& counted = all_sampled ? above_ : own;
    for (std::size_t i = 0; i < lit_.size(); ++i) {
        if (i / per_row % 2) continue;
        const std::uint64_t a = lit_[i], b = lit_[i + per_row], over_a = counted[i], over_b = counted[i + per_row];
        const std::uint64_t whole = over_a & over_a >> 1 & over_b & over_b >> 1 & kEven;
        const std::uint64_t odd = (a ^ a >> 1 ^ b ^ b >> 1) & whole;
        const std::uint64_t mixed = (a | a >> 1 | b | b >> 1) & ~(a & a >> 1 & b & b >> 1) & whole;
        // One or three of four lit, and two.
        sum += std::popcount(odd) + 4.0 / 3 * std::popcount(mixed & ~odd);
        known += 4 * std::size_t(std::popcount(whole));
        for (std::size_t x = 0; x < columns; x += 2) {
            if (whole >> x & 1) continue;
            const auto in_square = [x](std::uint64_t upper, std::uint64_t lower) {
                return std::popcount(upper >> x & 3) + std::popcount(lower >> x & 3);
            };
            const int lit_here = in_square(a & over_a, b & over_b), above_here = in_square(over_a, over_b);
            if (above_here < 2) continue;  // one sample has no variance
            sum += double(lit_here) * (above_here - lit_here) / (above_here - 1);
            known += std::size_t(above_here);
        }
    }
    if (known > 0) out.error = std::sqrt(sum / (double(known) * double(count(counted))));
    return out;
}

}  // namespace si
