// What is wrong with text that people read: bytes that are no UTF-8, and UTF-8 that was encoded twice.
#pragma once

#include <string>
#include <string_view>

namespace si::test {

/// UTF-8 of a code point.
std::string utf8(char32_t c);
/// The code points of well-formed UTF-8; U+FFFD for what is not.
std::u32string code_points(std::string_view text);

/// What is wrong with the text, with what stands around it; empty when nothing is.
std::string text_fault(std::string_view text);
std::string text_fault(const std::u32string& text);

}  // namespace si::test
