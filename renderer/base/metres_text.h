// Lengths for people.
#pragma once

#include <string>

namespace si {

/// Three significant digits with a prefix: "4.2 mm", "13 km"; "no distance" of what is not finite.
std::string metres_text(double metres);

}  // namespace si
