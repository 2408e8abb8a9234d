// Power laws and plots of times over the size of scenes and settings.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace si {

/// Milliseconds `ms` of one operation over sizes `x`, both positive.
struct Curve {
    std::string name;  ///< name of the timed operation
    std::vector<double> x, ms;
};

/// Returns the exponent k of the power law a x^k nearest to the points, by least squares of the logarithms; NaN for
/// fewer than two points.
double power_law(std::span<const double> x, std::span<const double> y);

/// Reads the JSON of `bench --benchmark_filter=^curve/ --benchmark_out=JSON` and draws one plot a varied size. @throws
/// Error if a file cannot be read or written
void draw_curves(const std::filesystem::path& json, const std::filesystem::path& png);

}  // namespace si
