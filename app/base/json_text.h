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

/// Parses a whole JSON text and keeps the order of members. Takes linear time.
/// @throws Error "NAME: line L, column C: what is wrong": broken or deeper than kMaxJsonDepth, a number out of range, a
/// member that occurs twice, text after the end
nlohmann::ordered_json parse_json_text(std::string_view text, const std::string& name);

/// Converts each element of a range to JSON by `convert`, in an array.
template <class Range, class Convert>
nlohmann::ordered_json json_list(const Range& range, const Convert& convert) {
    auto list = nlohmann::ordered_json::array();
    for (const auto& element : range) list.push_back(std::invoke(convert, element));
    return list;
}

/// Formats a JSON value for an error message: on one line, cut after some 60 characters.
std::string quoted(const nlohmann::ordered_json& value);

}  // namespace si
