#include "renderer/reference/distance_transform.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace si {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Lower envelope of the parabolas f[q] + (x - q)^2, sampled at each x.
class Envelope {
public:
    explicit Envelope(std::size_t n) : place_(n), from_(n + 1), out_(n) {}

    const std::vector<double>& transform(const std::vector<double>& f) {
        const int n = int(f.size());
        int k = -1;
        for (int q = 0; q < n; ++q) {
            if (f[std::size_t(q)] == kInfinite) continue;
            double s = -kInfinite;
            for (; k >= 0; --k) {
                const int p = place_[std::size_t(k)];
                s = (f[std::size_t(q)] + double(q) * q - f[std::size_t(p)] - double(p) * p) / (2.0 * (q - p));
                if (s > from_[std::size_t(k)]) break;
            }
            if (k < 0) s = -kInfinite;
            place_[std::size_t(++k)] = q;
            from_[std::size_t(k)] = s;
            from_[std::size_t(k) + 1] = kInfinite;
        }
        if (k < 0) {
            out_.assign(f.size(), kInfinite);
            return out_;
        }
        for (int x = 0, at = 0; x < n; ++x) {
            while (from_[std::size_t(at) + 1] < x) ++at;
            const double d = x - place_[std::size_t(at)];
            out_[std::size_t(x)] = d * d + f[std::size_t(place_[std::size_t(at)])];
        }
        return out_;
    }

private:
    std::vector<int> place_;
    std::vector<double> from_, out_;
};

constexpr int kNoneInColumn = 1 << 30;  ///< least distance that stands for a column without a set pixel

/// Returns the distances to the nearest set pixel of the same column, by one sweep down and one up.
std::vector<int> distances_in_columns(const std::vector<std::uint8_t>& set, int width, int height) {
    const auto w = std::size_t(width), n = w * std::size_t(height);
    std::vector<int> out(n);
    for (std::size_t x = 0; x < std::min(w, n); ++x) out[x] = set[x] ? 0 : kNoneInColumn;
    // Rows have loops of their own, since these are vectorised.
    for (std::size_t row = w; row < n; row += w)
        for (std::size_t x = 0; x < w; ++x) out[row + x] = set[row + x] ? 0 : out[row + x - w] + 1;
    for (std::size_t row = n; row > w; row -= w)
        for (std::size_t x = row - w; x < row; ++x) out[x - w] = std::min(out[x - w], out[x] + 1);
    return out;
}

}  // namespace

std::vector<float> distance_to(const std::vector<std::uint8_t>& set, int width, int height) {
    const auto w = std::size_t(width), h = std::size_t(height);
    const std::vector<int> in_column = distances_in_columns(set, width, height);
    std::vector<double> line(w);
    std::vector<float> distance(w * h);
    Envelope rows(w);
    for (std::size_t y = 0; y < h; ++y) {
        for (std::size_t x = 0; x < w; ++x) {
            const int d = in_column[y * w + x];
            line[x] = d < kNoneInColumn ? double(d) * d : kInfinite;
        }
        const std::vector<double>& out = rows.transform(line);
        for (std::size_t x = 0; x < w; ++x) distance[y * w + x] = float(std::sqrt(out[x]));
    }
    return distance;
}

NearestSetPixel::NearestSetPixel(const std::vector<std::uint8_t>& set, int width, int height)
    : width_(width), in_column_(distances_in_columns(set, width, height)) {}

float NearestSetPixel::distance(std::size_t pixel) const {
    const auto w = std::size_t(width_), x = pixel % w;
    const int* const row = &in_column_[pixel - x];
    double least = kInfinite;  // squared
    const auto compare = [&](std::size_t column, double aside) {
        if (row[column] < kNoneInColumn) least = std::min(least, aside * aside + double(row[column]) * row[column]);
    };
    for (std::size_t aside = 0; aside < w && double(aside) * double(aside) < least; ++aside) {
        if (aside <= x) compare(x - aside, double(aside));
        if (x + aside < w) compare(x + aside, double(aside));
    }
    return float(std::sqrt(least));
}

}  // namespace si
