// Text field to search a list.
#pragma once

#include <string>

#include "renderer/base/words_match.h"

namespace si {

/// Draws a text field over the free width, with a button that clears it. @param leave free pixels right of it
/// @param about addition to its tooltip, such as "; other engines' names count too"
void search_field(const char* id, const char* hint, std::string& text, float leave = 0, const char* about = "");

}  // namespace si
