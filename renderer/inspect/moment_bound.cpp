#include "renderer/inspect/moment_bound.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace si {
namespace {

/// Numbers of Chebyshev's bound v / (v + (z - m)^2).
struct Chebyshev {
    double variance = 0;  ///< of the moments
    double floor = 0;     ///< least variance that counts
    double behind = 0;    ///< z - m
    double bound() const {
        const double v = std::max(variance, floor);
        return behind <= 0 ? 1 : v / (v + behind * behind);
    }
};

/// Returns the bound of warped depths, relative to the receiver's own (warped_chebyshev() of lib/exponential.glsl).
/// @param exponent c of e^(c x), or -d of -e^(-d x)
Chebyshev warped(double mean, double square, double own, double exponent, double min_variance) {
    const double x = std::clamp(2 * own - 1, -1.1, 1.1);
    const double z = (exponent < 0 ? -1 : 1) * std::exp(exponent * x), size = std::abs(z), m = mean / size;
    const double spread = 2 * std::abs(exponent) * std::sqrt(min_variance);
    return {square / size / size - m * m, spread * spread, (z - mean) / size};
}

/// Writes out Chebyshev's bound. @param of words for the warped quantity, empty for depths
MomentBound written(const Chebyshev& c, std::string_view of, const FilterSettings& s) {
    MomentBound out;
    if (c.behind <= 0) {
        out.formula = fmt::format("1 as z <= m{}", of);
        return out;
    }
    out.formula =
        fmt::format("v / (v + (z - m)^2){} with v {:.3g}, z - m {:.3g}", of, std::max(c.variance, c.floor), c.behind);
    if (c.variance < c.floor) {
        out.clamp = fmt::format("v is the floor by filter.min_variance {:g}, as the moments' own is {:.3g}",
                                s.min_variance, c.variance);
        out.floor_spread = std::sqrt(s.min_variance);
    }
    return out;
}

}  // namespace

MomentBound moment_bound(const Filter& row, const FilterSettings& s, const KernelFacts& k) {
    const auto by_risen = [&] { return warped(k.moments[0], k.moments[1], k.own, s.exponent, s.min_variance); };
    switch (row.moments.rule) {
        case BoundRule::Chebyshev:
            return written({k.variance, s.min_variance, k.own - k.mean}, "", s);
        case BoundRule::WarpedChebyshev:
            return written(by_risen(), " of e^(c x) / e^(c z)", s);
        case BoundRule::TwoWarpedChebyshevs: {
            const Chebyshev risen = by_risen();
            const Chebyshev fallen = warped(k.moments[2], k.moments[3], k.own, -s.negative_exponent, s.min_variance);
            if (risen.bound() <= fallen.bound())
                return written(risen, fmt::format(" of e^(c x) / e^(c z), below {:.3g} by -e^(-d x)", fallen.bound()),
                               s);
            return written(fallen, fmt::format(" of -e^(-d x) / e^(-d z), below {:.3g} by e^(c x)", risen.bound()), s);
        }
        case BoundRule::Exponential: {
            const double exponent = std::log(k.moments[0]) - s.exponent * (2 * k.own - 1);
            return {fmt::format("e^(ln m - c x) with ln m {:.4g}, c x {:.4g}", std::log(k.moments[0]),
                                s.exponent * (2 * k.own - 1)),
                    exponent > 0 ? fmt::format("clamped from {:.3g} to 1", std::exp(exponent)) : ""};
        }
        case BoundRule::FourMoments:
            return {fmt::format("{} with share {:.3g}, z {:.6f}", row.moments.bound, 1 - k.bound, k.own),
                    s.moment_bias > 0
                        ? fmt::format("filter.moment_bias mixes {:g} of one half into the moments", s.moment_bias)
                        : ""};
    }
    return {};
}

}  // namespace si
