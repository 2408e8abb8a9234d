// Fonts embedded in the program; empty if none was found at build time.
#pragma once

#include <span>

namespace si {

/// Returns the embedded font for body text as the bytes of a TrueType file; empty: none.
std::span<const unsigned char> regular_font();
/// Returns the embedded font of medium weight as the bytes of a TrueType file; empty: none.
std::span<const unsigned char> medium_font();
/// Returns the embedded bold font as the bytes of a TrueType file; empty: none.
std::span<const unsigned char> strong_font();

}  // namespace si
