// Percent escapes in URIs (RFC 3986, 2.1).
#pragma once

#include <charconv>
#include <string>
#include <string_view>

namespace si {

/// Decodes percent escapes of a URI: "%41" becomes "A". A '%' that starts no escape stays, as in file names that were
/// never encoded.
inline std::string percent_decode(std::string_view uri) {
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const char* const digits = uri.data() + i + 1;
        unsigned byte = 0;
        const bool escaped =
            uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2;
        out += escaped ? static_cast<char>(byte) : uri[i];
        if (escaped) i += 2;
    }
    return out;
}

}  // namespace si
