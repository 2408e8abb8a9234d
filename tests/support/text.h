// Finds missing parts of texts, and encoding faults: bytes that are not UTF-8 and text that was encoded twice.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace si::test {

/// Returns the UTF-8 bytes of a code point.
std::string utf8(char32_t c);
/// Decodes UTF-8 to code points. Malformed bytes become U+FFFD.
std::u32string code_points(std::string_view text);

/// Finds parts that a text lacks.
/// @returns the first missing part with the text; empty if the text has all parts
std::string lacking(std::string_view text, std::initializer_list<std::string_view> parts);

/// Finds the first encoding fault of a UTF-8 text.
/// @returns the kind of fault with the surrounding text; empty if the text has no fault
std::string text_fault(std::string_view text);
/// Finds the first encoding fault of decoded text, where U+FFFD stands for malformed bytes.
/// @returns the kind of fault with the surrounding text; empty if the text has no fault
std::string text_fault(const std::u32string& text);

}  // namespace si::test
