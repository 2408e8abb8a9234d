// Lengths and other quantities for people: no exponents, no digits that say nothing.
#pragma once

#include <string>

namespace si {

/// Three significant digits or all before the point: "0.628", "41.2", "1250"; one below 1/10,000: "0.00006".
std::string digits_text(double value);
/// The same with its sign: "+0.628".
std::string signed_text(double value);

/// The same with a prefix: "4.2 mm", "1250 m", "13 km"; "no distance" of what
/// is not finite.
std::string metres_text(double metres);

/// Of texels of a map: "0.63 texels", "1 texel", "1250 texels", "2.5 million texels"; "infinitely many texels"
/// of what is not finite.
std::string texels_text(double texels);

}  // namespace si
