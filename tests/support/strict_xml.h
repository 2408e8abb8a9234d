// Checks that a text is well-formed XML of elements, attributes and words.
#pragma once

#include <string>
#include <string_view>

namespace si::test {

/// Checks that a text is well-formed XML. Declarations, comments and CDATA are errors, since the program writes none.
/// @returns the first fault and its place; empty for well-formed text
std::string xml_fault(std::string_view text);

}  // namespace si::test
