// A field to search a list by.
#pragma once

#include <string>

#include "renderer/base/words_match.h"

namespace si {

/// A text field with a button that clears it while something is in it. Width: all that is left, less `leave` pixels.
/// @param about what its tooltip says besides, such as "; other engines' names count too"
void search_field(const char* id, const char* hint, std::string& text, float leave = 0, const char* about = "");

}  // namespace si
