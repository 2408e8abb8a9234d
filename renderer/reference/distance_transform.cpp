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

}  // namespace

std::vector<float> distance_to(const std::vector<std::uint8_t>& set, int width, int height) {
    const auto w = std::size_t(width), h = std::size_t(height);
    // Distances within columns, by one sweep down and one up.
    std::vector<double> in_column(w * h);
    for (std::size_t i = 0; i < w * h; ++i) in_column[i] = set[i] ? 0 : i < w ? kInfinite : in_column[i - w] + 1;
    for (std::size_t i = w * h; i-- > w;) in_column[i - w] = std::min(in_column[i - w], in_column[i] + 1);
    std::vector<double> line(w);
    std::vector<float> distance(w * h);
    Envelope rows(w);
    for (std::size_t y = 0; y < h; ++y) {
        for (std::size_t x = 0; x < w; ++x) line[x] = in_column[y * w + x] * in_column[y * w + x];
        const std::vector<double>& out = rows.transform(line);
        for (std::size_t x = 0; x < w; ++x) distance[y * w + x] = float(std::sqrt(out[x]));
    }
    return distance;
}

}  // namespace si
