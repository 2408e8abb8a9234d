// The fonts that travel inside the binary; empty when none was found at build time.
#pragma once

#include <span>

namespace si {

std::span<const unsigned char> regular_font();
std::span<const unsigned char> strong_font();

}  // namespace si
