// Lengths and other quantities as text for people: three significant digits, no exponents.
#pragma once

#include <string>

namespace si {

/// Formats a number for people with three significant digits, or all digits before the point: "0.628", "41.2", "1250".
/// Numbers below 1/10,000 have one digit: "0.00006".
std::string digits_text(double value);
/// Formats a number with its sign and three significant digits: "+0.628".
std::string signed_text(double value);

/// Formats a length in metres with a fitting unit: "4.2 mm", "1250 m", "13 km". "no distance" when not finite.
std::string metres_text(double metres);

/// Formats a length in texels of a shadow map: "0.63 texels", "1 texel", "2.5 million texels". "infinitely many texels"
/// when not finite.
std::string texels_text(double texels);

}  // namespace si
