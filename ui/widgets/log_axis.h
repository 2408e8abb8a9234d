// A logarithmic axis that fits its values, zero included.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace si {

struct LogAxis {
    double low = 0.1, high = 10;  ///< ends of the logarithmic part, 0 < low < high
    bool zero = false;            ///< values of zero (or less) have a place before `low`
    struct Tick {
        double value = 0;
        std::string text;  ///< empty: a line without a number
    };
    std::vector<Tick> ticks;  ///< within low..high, rising; zero first where it has a place

    /// 0..1 along the axis; zero at 0, the logarithmic part from kZeroShare where zero has a place.
    double at(double value) const;
    static constexpr double kZeroShare = 0.07;
};

/// Values that are not finite do not count; without any the axis is that of the default. @param bytes they are: numbers
/// are powers of two and parts of them, "512 KiB", "1.5 MiB"
LogAxis log_axis(std::span<const double> values, bool bytes = false);

}  // namespace si
