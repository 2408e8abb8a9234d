// Percent escapes in URIs (RFC 3986, 2.1).
#pragma once

#include <string>
#include <string_view>

namespace si {

/// Decodes percent escapes of a URI: "%41" becomes "A". A '%' that starts no escape stays, as in file names that were
/// never encoded.
inline std::string percent_decode(std::string_view uri) {
    const auto hex_value = [](char c) {
        if (c >= '0' && c <= '9') return c - '0';
        if (c >= 'a' && c <= 'f') return c - 'a' + 10;
        if (c >= 'A' && c <= 'F') return c - 'A' + 10;
        return -1;
    };
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && hex_value(uri[i + 1]) >= 0 && hex_value(uri[i + 2]) >= 0) {
            out += static_cast<char>(hex_value(uri[i + 1]) * 16 + hex_value(uri[i + 2]));
            i += 2;
        } else {
            out += uri[i];
        }
    }
    return out;
}

}  // namespace si
