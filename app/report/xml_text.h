// Text in XML files.
#pragma once

#include <string>

namespace si {

/// Escapes a text for an attribute or an element of XML. Control characters and broken UTF-8, which XML does not allow,
/// become visible escapes.
std::string xml_text(const std::string& text);

}  // namespace si
