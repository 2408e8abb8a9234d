// Search by words.
#pragma once

#include <initializer_list>
#include <string_view>

namespace si {

/// Returns true when every word of the search `text` occurs in one of the texts `places`, ignoring case. True for an
/// empty search.
bool matches_all_words(std::string_view text, std::initializer_list<std::string_view> places);

}  // namespace si
