// Text field to search a list.
#pragma once

#include <string>

#include "renderer/base/words_match.h"

namespace si {

/// Draws a search field over the free width, with a button that clears it. @param hint text of the empty field
/// @param leave the pixels to leave free to the right of the field @param about an addition to the field's tooltip,
/// such as "; other engines' names count too"
void search_field(const char* id, const char* hint, std::string& text, float leave = 0, const char* about = "");

}  // namespace si
