#include "renderer/base/printable.h"

#include <fmt/format.h>

namespace si {
namespace {

struct Decoded {
    char32_t code = 0;
    std::size_t bytes = 0;  ///< 0: not valid UTF-8
};

Decoded decode(std::string_view s) {
    const auto at = [&](std::size_t i) { return static_cast<unsigned char>(s[i]); };
    const unsigned char lead = at(0);
    const std::size_t n = lead < 0x80 ? 1 : (lead >> 5) == 6 ? 2 : (lead >> 4) == 14 ? 3 : (lead >> 3) == 30 ? 4 : 0;
    if (n == 0 || n > s.size()) return {};
    static constexpr unsigned char kMask[] = {0, 0x7f, 0x1f, 0x0f, 0x07};
    char32_t code = lead & kMask[n];
    for (std::size_t i = 1; i < n; ++i) {
        if ((at(i) >> 6) != 2) return {};
        code = (code << 6) | (at(i) & 0x3f);
    }
    return {code, n};
}

/// Returns true for characters that move the cursor, hide text or change its direction.
bool is_unsafe(char32_t c) {
    return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x061c || (c >= 0x200b && c <= 0x200f) ||
           (c >= 0x2028 && c <= 0x202e) || (c >= 0x2060 && c <= 0x2069) || c == 0xfeff ||
           (c >= 0xd800 && c <= 0xdfff) || c > 0x10ffff;
}

}  // namespace

std::string printable(std::string_view text, std::size_t max_bytes) {
    std::string out;
    while (!text.empty()) {
        if (out.size() >= max_bytes) return out + "…";
        const Decoded d = decode(text);
        if (d.bytes == 0 || (d.bytes == 1 && is_unsafe(d.code))) {
            out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
            text.remove_prefix(1);
        } else if (is_unsafe(d.code)) {
            out += fmt::format("\\u{:04x}", static_cast<unsigned>(d.code));
            text.remove_prefix(d.bytes);
        } else {
            out += text.substr(0, d.bytes);
            text.remove_prefix(d.bytes);
        }
    }
    return out;
}

bool is_utf8(std::string_view text) {
    constexpr char32_t kFirstOfLength[] = {0, 0, 0x80, 0x800, 0x10000};  // shorter forms are not valid
    while (!text.empty()) {
        const Decoded d = decode(text);
        const bool surrogate = d.code >= 0xd800 && d.code <= 0xdfff;
        if (d.bytes == 0 || d.code < kFirstOfLength[d.bytes] || surrogate || d.code > 0x10ffff) return false;
        text.remove_prefix(d.bytes);
    }
    return true;
}

}  // namespace si
