// JSON that other programs and people wrote, read within bounds.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace si {

/// Deeper than anything that the program writes; what walks over a JSON tree needs a stack frame for each level.
inline constexpr int kDeepestJson = 32;

/// A whole text, members in its order, in time that grows with its length.
/// @throws Error "NAME: line L, column C: what is wrong": broken or deeper than kDeepestJson, a number beyond range, a
/// member that stands there twice, anything after the end
nlohmann::ordered_json parse_json_text(std::string_view text, const std::string& name);

/// A value as messages quote it: on one line, cut after some 60 characters.
std::string quoted(const nlohmann::ordered_json& value);

}  // namespace si
