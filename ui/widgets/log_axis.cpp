#include "ui/widgets/log_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace si {
namespace {

constexpr double kMargin = 0.06;      // of the logarithm's range, beyond the outermost values
constexpr double kLeastRange = 0.15;  // decades

std::string tick_text(double value) {
    if (value >= 0.001 && value < 1e5) return fmt::format("{:.6g}", value);
    return fmt::format("{:.0e}", value);
}

}  // namespace

double LogAxis::at(double value) const {
    const double begin = zero ? kZeroShare : 0;
    if (value <= 0) return 0;
    const double share = std::log(value / low) / std::log(high / low);
    return begin + (1 - begin) * std::clamp(share, 0.0, 1.0);
}

LogAxis log_axis(std::span<const double> values) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    LogAxis axis;
    for (const double v : values) {
        if (!std::isfinite(v)) continue;
        if (v <= 0)
            axis.zero = true;
        else
            least = std::min(least, v), most = std::max(most, v);
    }
    if (most > 0) {
        double lo = std::log10(least), hi = std::log10(most);
        const double more = std::max(kMargin * (hi - lo), 0.5 * (kLeastRange - (hi - lo)));
        lo -= more, hi += more;
        axis.low = std::pow(10, lo), axis.high = std::pow(10, hi);
    }
    if (axis.zero) axis.ticks.push_back({0, "0"});
    const double decades = std::log10(axis.high / axis.low);
    // The fewer decades, the more of 1 to 9 in each has a line, and of those a number.
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
            axis.ticks.push_back({value, text ? tick_text(value) : ""});
        }
    return axis;
}

}  // namespace si
