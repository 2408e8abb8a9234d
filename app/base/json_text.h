// Parsing of JSON from files, with limits on depth and helpful errors, and lists as JSON.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace si {

/// JSON that keeps the order of members.
using Json = nlohmann::ordered_json;

/// Largest nesting depth of JSON that is read. Walking over a JSON tree recurses once per level; the program's own
/// files are shallower.
inline constexpr int kMaxJsonDepth = 32;

/// Parses a whole JSON text. Objects keep the order of their members. The time grows linearly with the text.
/// @param name name of the file, for error messages
/// @throws Error "NAME: line L, column C: what is wrong". Errors are broken JSON, nesting deeper than kMaxJsonDepth,
/// numbers out of range, repeated members, and text after the end
nlohmann::ordered_json parse_json_text(std::string_view text, const std::string& name);

/// Returns a JSON array of the elements of a range, each converted by `convert`.
template <class Range, class Convert>
nlohmann::ordered_json json_list(const Range& range, const Convert& convert) {
    auto list = nlohmann::ordered_json::array();
    for (const auto& element : range) list.push_back(std::invoke(convert, element));
    return list;
}

/// Formats a JSON value for an error message, on one line and cut after about 60 characters.
std::string quoted(const nlohmann::ordered_json& value);

}  // namespace si
