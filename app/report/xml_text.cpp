#include "app/report/xml_text.h"

#include <string_view>
#include <utility>

#include "renderer/base/printable.h"

namespace si {

std::string xml_text(const std::string& text) {
    static constexpr std::pair<std::string_view, std::string_view> kEscapes[] = {{"&", "&amp;"},
                                                                                 {"<", "&lt;"},
                                                                                 {">", "&gt;"},
                                                                                 {"\"", "&quot;"},
                                                                                 {"\xef\xbf\xbe", "\\ufffe"},
                                                                                 {"\xef\xbf\xbf", "\\uffff"}};
    // Control characters, which XML cannot hold, become visible escapes first.
    std::string out = printable(text, text.size() * 8 + 16);
    for (const auto& [raw, escape] : kEscapes)
        for (std::size_t at = 0; (at = out.find(raw, at)) != out.npos; at += escape.size())
            out.replace(at, raw.size(), escape);
    return out;
}

}  // namespace si
