#include "ui/widgets/log_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ui/widgets/quantity_text.h"

namespace si {
namespace {

constexpr double kMargin = 0.06;    // margin beyond the outermost values, as a share of the logarithm's range
constexpr double kMinRange = 0.15;  // smallest range, decades

std::string bytes_tick_text(double value) {
    constexpr double kKiB = 1024, kMiB = kKiB * kKiB;
    if (value < kKiB) return stored_text(value, 6) + " B";
    return value < kMiB ? stored_text(value / kKiB, 6) + " KiB" : stored_text(value / kMiB, 6) + " MiB";
}

/// Adds ticks at powers of two, at most about eight with numbers; for short ranges also fractions of them.
void add_bytes_ticks(LogAxis& axis) {
    const double octaves = std::log2(axis.high / axis.low);
    const int parts = octaves < 1 ? 8 : octaves < 3 ? 4 : 1;
    const int every = std::max(1, int(std::ceil(octaves / 8)));
    for (int octave = int(std::floor(std::log2(axis.low))); octave <= int(std::ceil(std::log2(axis.high))); ++octave)
        for (int part = 0; part < parts; ++part) {
            const double value = std::exp2(octave) * (1 + double(part) / parts);
            if (value < axis.low || value > axis.high) continue;
            const bool text = octave % every == 0 && (octaves < 1.5 || part == 0 || part == parts / 2);
            axis.ticks.push_back({value, text ? bytes_tick_text(value) : ""});
        }
}

}  // namespace

double LogAxis::position(double value) const {
    const double begin = zero ? kZeroShare : 0;
    if (value <= 0) return 0;
    const double share = std::log(value / low) / std::log(high / low);
    return begin + (1 - begin) * std::clamp(share, 0.0, 1.0);
}

LogAxis log_axis(std::span<const double> values, bool bytes) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    LogAxis axis;
    for (const double v : values) {
        if (!std::isfinite(v)) continue;
        if (v <= 0)
            axis.zero = true;
        else {
            least = std::min(least, v);
            most = std::max(most, v);
        }
    }
    if (most > 0) {
        double lo = std::log10(least), hi = std::log10(most);
        const double more = std::max(kMargin * (hi - lo), 0.5 * (kMinRange - (hi - lo)));
        lo -= more;
        hi += more;
        axis.low = std::pow(10, lo);
        axis.high = std::pow(10, hi);
    }
    if (axis.zero) axis.ticks.push_back({0, bytes ? "0 B" : "0"});
    if (bytes) {
        add_bytes_ticks(axis);
        return axis;
    }
    const double decades = std::log10(axis.high / axis.low);
    // Fewer decades get more lines within each decade, and more numbers.
    const auto numbered = [&](int digit) {
        if (digit == 1 || decades < 0.7) return true;
        if (decades < 1.6) return digit == 2 || digit == 3 || digit == 5;
        return decades < 2.5 && (digit == 2 || digit == 5);
    };
    const double every = std::max(1.0, std::ceil(decades / 8));  // decades between numbers
    for (int decade = int(std::floor(std::log10(axis.low))); decade <= int(std::ceil(std::log10(axis.high))); ++decade)
        for (int digit = 1; digit <= 9; ++digit) {
            const double value = digit * std::pow(10, decade);
            if (value < axis.low || value > axis.high) continue;
            const bool text = numbered(digit) && decade % int(every) == 0;
            if (!text && decades > 1.6) continue;
            axis.ticks.push_back({value, text ? stored_text(value, 6) : ""});
        }
    return axis;
}

}  // namespace si
