// Sine and cosine of angles in degrees, exact at multiples of 90.
#pragma once

#include <cmath>
#include <numbers>

namespace si {

inline constexpr double kDegree = std::numbers::pi / 180;  ///< radians in one degree

/// Sine and cosine of one angle; the default is the angle 0.
struct SineCosine {
    double sine = 0, cosine = 1;
};

/// Returns sine and cosine of an angle in degrees, exact at multiples of 90. Conversion to radians would leave an error
/// of 6e-17 there, enough to classify a surface parallel to the light as lit.
inline SineCosine sine_cosine(double degrees) {
    int quarter = 0;
    const double rest = std::remquo(degrees, 90.0, &quarter) * kDegree;
    const double s = std::sin(rest), c = std::cos(rest);
    const double turned[] = {s, c, -s, -c};
    // Adding 0 takes the sign off a zero, on which the basis about a direction would depend.
    return {turned[quarter & 3] + 0.0, turned[(quarter + 1) & 3] + 0.0};
}

}  // namespace si
