// A field to search a list by, and what it finds.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace si {

/// A text field with a button that clears it while something is in it. Width: all that is left, less `leave` pixels.
void search_field(const char* id, const char* hint, std::string& text, float leave = 0);

/// Whether each word of `text` stands in one of `places`, whatever the case of its letters. No word: it does.
bool words_match(std::string_view text, std::initializer_list<std::string_view> places);

}  // namespace si
