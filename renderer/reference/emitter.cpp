#include "renderer/reference/emitter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "renderer/base/directions.h"
#include "renderer/base/key.h"

namespace si {

/// Sample point on a light: its place on the unit disk, and its cell.
struct LightSamplePoint {
    glm::vec2 disk{0};
    LightCell cell;
};

namespace {

constexpr double kPi = std::numbers::pi;

constexpr std::uint32_t kScramblings = LightSamples::kScramblings;
constexpr int kKeptDigits = LightSamples::kSquareDigits;
constexpr std::uint32_t kKept =
    1u << kKeptDigits;  ///< kept points of each scrambling; others are computed when asked for

/// Maps [-1,1]^2 to the unit disk, preserving areas.
glm::dvec2 on_disk(double x, double y) {
    if (x == 0 && y == 0) return {0, 0};
    const bool wide = std::abs(x) > std::abs(y);
    const double r = wide ? x : y;
    const double angle = wide ? kPi / 4 * (y / x) : kPi / 2 - kPi / 4 * (x / y);
    return r * glm::dvec2(std::cos(angle), std::sin(angle));
}

/// Returns the digits of k in base 2, mirrored at the point: the first dimension of the sequence.
std::uint32_t mirrored_digits(std::uint32_t k) {
    std::uint32_t out = 0;
    for (int bit = 0; bit < 32; ++bit) out |= (k >> bit & 1u) << (31 - bit);
    return out;
}

/// Returns the second dimension of Sobol's sequence, whose generator matrix is Pascal's triangle modulo 2.
std::uint32_t sobol_second(std::uint32_t k) {
    std::uint32_t out = 0;
    for (std::uint32_t column = 1u << 31; k != 0; k >>= 1, column ^= column >> 1)
        if (k & 1u) out ^= column;
    return out;
}

/// Scrambles the digits of a number in [0, 1): each is flipped or not, by a hash of the digits before it.
std::uint32_t nested_scramble(std::uint32_t digits, std::uint64_t seed) {
    std::uint32_t out = 0;
    for (int bit = 31; bit >= 0; --bit) {
        const std::uint64_t before = bit == 31 ? 0 : digits >> (bit + 1);
        const auto flip = std::uint32_t(splitmix64(seed + (std::uint64_t(32 - bit) << 32) + before) & 1u);
        out |= ((digits >> bit & 1u) ^ flip) << bit;
    }
    return out;
}

LightSamplePoint make_point(std::uint32_t scrambling, std::uint32_t k) {
    const std::uint64_t seed = splitmix64(scrambling);
    const std::uint32_t x = nested_scramble(mirrored_digits(k), seed),
                        y = nested_scramble(sobol_second(k), splitmix64(seed));
    const auto side = [](std::uint32_t digits) { return 2 * (double(digits) + 0.5) * 0x1p-32 - 1; };
    return {glm::vec2(on_disk(side(x), side(y))), {std::uint16_t(x >> 16), std::uint16_t(y >> 16)}};
}

/// Returns the first kKept points of a scrambling.
const LightSamplePoint* kept_points(std::uint32_t scrambling) {
    static const std::vector<LightSamplePoint> kept = [] {
        std::vector<LightSamplePoint> out;
        out.reserve(kScramblings * kKept);
        for (std::uint32_t s = 0; s < kScramblings; ++s)
            for (std::uint32_t i = 0; i < kKept; ++i) out.push_back(make_point(s, i));
        return out;
    }();
    return &kept[std::size_t(scrambling) * kKept];
}

/// Kept sample points of all scramblings, ordered by cell, for grids of 1, 2, 4 ... kKept cells.
class KeptOrders {
public:
    /// Orders the points. @param place_of place of a cell in a grid of 2^digits cells
    explicit KeptOrders(std::size_t (*place_of)(const LightCell& cell, int digits))
        : points_(kScramblings * kOfScrambling) {
        for (std::uint32_t s = 0; s < kScramblings; ++s)
            for (int d = 0; d <= kKeptDigits; ++d)
                for (std::uint32_t k = 0, n = 1u << d; k < n; ++k)
                    points_[s * kOfScrambling + n - 1 + place_of(kept_points(s)[k].cell, d)] = std::uint16_t(k);
    }
    /// Returns the points of one scrambling in a grid of 2^digits cells.
    std::span<const std::uint16_t> points(std::uint32_t scrambling, int digits) const {
        const std::size_t n = std::size_t{1} << digits;
        return {&points_[scrambling * kOfScrambling + n - 1], n};
    }

private:
    // A grid of n cells starts at n - 1.
    static constexpr std::size_t kOfScrambling = 2 * kKept - 1;
    std::vector<std::uint16_t> points_;
};

/// Returns the kept sample point of each cell, by LightCell::index(), of a grid of at most kKept cells.
std::span<const std::uint16_t> kept_points_in_cells(std::uint32_t scrambling, int digits) {
    static const KeptOrders kept([](const LightCell& cell, int d) { return cell.index(d); });
    return kept.points(scrambling, digits);
}

/// Returns the kept sample point of each cell of a grid of at most kKept cells, in the order of a Z curve: cells of a
/// square follow each other.
std::span<const std::uint16_t> kept_points_in_squares(std::uint32_t scrambling, int digits) {
    static const KeptOrders kept([](const LightCell& cell, int d) {
        std::size_t place = 0;
        for (int bit = 0; bit < d; ++bit) place = place << 1 | ((bit % 2 ? cell.y : cell.x) >> (15 - bit / 2) & 1);
        return place;
    });
    return kept.points(scrambling, digits);
}

}  // namespace

Emitter emitter_of(const FittedLight& light, const LightSettings& settings) {
    const double size = std::isfinite(settings.size) ? std::max(settings.size, 0.0) : 0.0;
    return {light.type, light.position, light.to_light, light.cos_cone_outer, light.range_m, size, light.shadowed};
}

LightSamples::LightSamples(const Emitter& emitter, const glm::dvec3& point_ws, std::uint64_t pixel)
    : emitter_(emitter), point_(point_ws) {
    const std::uint64_t seed = splitmix64(pixel);
    scrambling_ = std::uint32_t(seed % kScramblings);
    points_ = kept_points(scrambling_);
    const glm::dvec3 towards = emitter.direction_from(point_ws, distance_);
    const glm::dmat3 basis = orthonormal_basis(emitter.type == LightType::Spot ? emitter.to_light : towards);
    const double angle = 2 * kPi * double(seed >> 32) * 0x1p-32, cosine = std::cos(angle), sine = std::sin(angle);
    axes_ = {cosine * basis[0] + sine * basis[1], cosine * basis[1] - sine * basis[0], basis[2]};
    if (emitter.type == LightType::Spot) {
        radius_ = emitter.size;
    } else if (emitter.type == LightType::Directional) {
        const double half = 0.5 * std::min(emitter.size, 90.0) * kPi / 180;
        one_minus_cos_ = 2 * std::sin(half) * std::sin(half);
    } else {
        // Inside the sphere, half of all directions.
        const double outline = distance_ > emitter.size ? emitter.size / distance_ : 1.0;
        one_minus_cos_ = outline * outline / (1 + std::sqrt(std::max(1 - outline * outline, 0.0)));
    }
}

LightRay LightSamples::ray(std::uint32_t k) const {
    const glm::dvec2 disk(k < kKept ? points_[k].disk : make_point(scrambling_, k).disk);
    if (emitter_.type == LightType::Spot) {
        const glm::dvec3 towards = emitter_.position_ws + radius_ * (disk.x * axes_[0] + disk.y * axes_[1]) - point_;
        const double length_m = glm::length(towards);
        return {towards / length_m, length_m};
    }
    // Lambert's azimuthal equal-area projection, onto the cap of directions.
    const double h = one_minus_cos_ * glm::dot(disk, disk);
    const glm::dvec2 across = disk * std::sqrt(one_minus_cos_ * (2 - h));
    const glm::dvec3 direction = axes_ * glm::dvec3(across, 1 - h);
    if (emitter_.type == LightType::Directional) return {direction};
    // Distance to the sphere's near side.
    const double along = distance_ * (1 - h), r2 = emitter_.size * emitter_.size;
    const double beside2 = std::max(distance_ * distance_ - along * along, 0.0);
    const double chord = std::sqrt(std::max(r2 - beside2, 0.0));
    const double length_m = distance_ > emitter_.size ? along - chord : along + chord;
    return {direction, std::max(length_m, 1e-12 * emitter_.size)};
}

std::optional<LightDisk> LightSamples::disk() const {
    // Beyond this tangent, places on a plane at distance 1 lose precision.
    const double kMostTangent = std::sqrt(3.0);
    LightDisk out{.axes = axes_};
    if (emitter_.type == LightType::Spot) {
        const glm::dvec3 centre = glm::transpose(axes_) * (emitter_.position_ws - point_);
        if (!(centre.z > 0)) return std::nullopt;
        out.centre = glm::dvec2(centre) / centre.z;
        out.radius = radius_ / centre.z;
        out.near_m = out.far_m = centre.z;
    } else {
        const double cosine = 1 - one_minus_cos_;
        if (!(cosine > 0)) return std::nullopt;
        out.radius = std::sqrt(one_minus_cos_ * (2 - one_minus_cos_)) / cosine;
        if (emitter_.type == LightType::Point) {
            if (!(distance_ > emitter_.size)) return std::nullopt;
            out.near_m = distance_ - emitter_.size;
            out.far_m = distance_ - emitter_.size * emitter_.size / distance_;
        }
    }
    if (!(glm::length(out.centre) + out.radius <= kMostTangent)) return std::nullopt;
    return out;
}

void LightSamples::find_places(std::span<const std::uint32_t> points, std::span<float> x, std::span<float> y) const {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::uint32_t k = points[i];
        const glm::vec2 disk = k < kKept ? points_[k].disk : make_point(scrambling_, k).disk;
        x[i] = disk.x;
        y[i] = disk.y;
    }
    if (emitter_.type == LightType::Spot) {
        const glm::dvec3 centre = glm::transpose(axes_) * (emitter_.position_ws - point_);
        const auto radius = float(radius_ / centre.z);
        const glm::vec2 place(glm::dvec2(centre) / centre.z);
        for (std::size_t i = 0; i < points.size(); ++i) {
            x[i] = place.x + radius * x[i];
            y[i] = place.y + radius * y[i];
        }
        return;
    }
    // Tangents of the directions that ray() returns.
    const auto cap = float(one_minus_cos_);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float h = cap * (x[i] * x[i] + y[i] * y[i]);
        const float tangent = std::sqrt(cap * (2 - h)) / (1 - h);
        x[i] *= tangent;
        y[i] *= tangent;
    }
}

void LightSamples::points_in_squares(int digits, std::vector<std::uint32_t>& out) const {
    const std::span<const std::uint16_t> kept = kept_points_in_squares(scrambling_, digits);
    out.assign(kept.begin(), kept.end());
}

LightCell LightSamples::cell(std::uint32_t k) const {
    return k < kKept ? points_[k].cell : make_point(scrambling_, k).cell;
}

void LightSamples::points_in_cells(int digits, std::vector<std::uint32_t>& out) const {
    if (digits <= kKeptDigits) {
        const std::span<const std::uint16_t> kept = kept_points_in_cells(scrambling_, digits);
        out.assign(kept.begin(), kept.end());
        return;
    }
    out.resize(std::size_t{1} << digits);
    for (std::uint32_t k = 0; k < out.size(); ++k) out[cell(k).index(digits)] = k;
}

}  // namespace si
