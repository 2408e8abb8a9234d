// Search by words.
#pragma once

#include <initializer_list>
#include <string_view>

namespace si {

/// Returns true when each word of a search text occurs in at least one of several texts, ignoring case. True for an
/// empty search.
/// @param text words to search for, as the user types them
/// @param places texts that are searched
bool matches_all_words(std::string_view text, std::initializer_list<std::string_view> places);

}  // namespace si
