// Numbers with units as all panels print them: few digits, no exponents.
#pragma once

#include <string>
#include <string_view>

namespace si {

/// Formats a number with its unit: three significant digits, a prefix that fits a length ("3.13 m", "4.2 mm"),
/// "million" and "billion" for large numbers ("4.19 million px"), "41.2°" for degrees. Returns "no value" for a number
/// that is not finite.
/// @param unit as tables of settings, metrics and overlays name it; empty: none
std::string quantity_text(double value, std::string_view unit = {});

/// Formats a share in percent: 0.125 as "12.5 %". Returns "no value" for a number that is not finite.
std::string percent_text(double share);

/// Formats a number with `digits` significant digits and without an exponent, for values that differ by little, such as
/// depths: "0.0000123". Numbers of more than fifteen digits get a power of ten: "3.2 × 10^36".
std::string stored_text(double value, int digits);

}  // namespace si
