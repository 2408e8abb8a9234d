// How times grow with what a scene and its settings ask for.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace si {

/// Times over amounts of one thing, both positive.
struct Curve {
    std::string name;  ///< what takes the time
    std::vector<double> x, ms;
};

/// The exponent k of the power law a x^k nearest to the points, by least squares of the logarithms; NaN below two.
double power_law(std::span<const double> x, std::span<const double> y);

/// Reads what `bench --benchmark_filter=^curve/ --benchmark_out=JSON` wrote and draws it, a plot for each thing that
/// grows. @throws Error
void draw_curves(const std::filesystem::path& json, const std::filesystem::path& png);

}  // namespace si
