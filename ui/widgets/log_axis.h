// A logarithmic axis that fits its values, zero included.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace si {

/// Logarithmic axis of a plot: ends and ticks, and if needed a place for the value zero.
struct LogAxis {
    double low = 0.1;   ///< lower end of the logarithmic part, above 0
    double high = 10;   ///< upper end of the logarithmic part, above `low`
    bool zero = false;  ///< values of zero (or less) have a place before `low`
    /// Tick of a plot's axis: a line across the plot, with or without a number.
    struct Tick {
        double value = 0;
        std::string text;  ///< empty: a line without a number
    };
    std::vector<Tick> ticks;  ///< within low..high, rising; zero first if it has a place

    /// Returns the position of a value along the logarithmic axis, 0..1. If zero has a place, its position is 0 and the
    /// logarithmic part starts at kZeroShare.
    double position(double value) const;
    static constexpr double kZeroShare = 0.07;
};

/// Makes a logarithmic axis of a plot that spans all finite values. Without a finite value above 0 it has the default
/// ends. @param bytes true: values are bytes, with ticks at powers of two ("512 KiB")
LogAxis log_axis(std::span<const double> values, bool bytes = false);

}  // namespace si
