#include "renderer/base/words_match.h"

#include <algorithm>
#include <cctype>

namespace si {
namespace {

bool holds_word(std::string_view place, std::string_view word) {
    const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
    return std::search(place.begin(), place.end(), word.begin(), word.end(), same) != place.end();
}

}  // namespace

bool matches_all_words(std::string_view text, std::initializer_list<std::string_view> places) {
    while (true) {
        const auto begin = std::ranges::find_if_not(text, [](unsigned char c) { return std::isspace(c); });
        text.remove_prefix(std::size_t(begin - text.begin()));
        if (text.empty()) return true;
        const auto end = std::ranges::find_if(text, [](unsigned char c) { return std::isspace(c); });
        const std::string_view word = text.substr(0, std::size_t(end - text.begin()));
        if (std::ranges::none_of(places, [&](std::string_view place) { return holds_word(place, word); })) return false;
        text.remove_prefix(word.size());
    }
}

}  // namespace si
