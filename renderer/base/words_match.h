// What is searched for by words.
#pragma once

#include <initializer_list>
#include <string_view>

namespace si {

/// Whether each word of `text` stands in one of `places`, whatever the case of its letters. No word: it does.
bool matches_all_words(std::string_view text, std::initializer_list<std::string_view> places);

}  // namespace si
