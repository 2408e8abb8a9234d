// Whether a text is XML, for what the program writes: elements, attributes, words. No declarations, comments or CDATA.
#pragma once

#include <string>
#include <string_view>

namespace si::test {

/// What is wrong and where; empty when it is well formed.
std::string xml_fault(std::string_view text);

}  // namespace si::test
