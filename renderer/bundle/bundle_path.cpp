#include "renderer/bundle/bundle_path.h"

#include <algorithm>

#include "renderer/base/printable.h"

namespace si {

std::string_view bundle_path_fault(std::string_view name) {
    constexpr std::size_t kMaxNameBytes = 1000;
    if (name.empty()) return "is empty";
    if (name.size() > kMaxNameBytes) return "is longer than 1000 bytes";
    if (name.front() == '/') return "begins with /";
    for (const char c : name) {
        if (c == '\\') return "has a backslash";
        if (c == ':') return "has a colon";
        if ((unsigned char)c < 0x20 || c == 0x7f) return "has a control character";
    }
    if (!is_utf8(name)) return "is not valid UTF-8";
    for (std::size_t start = 0; start <= name.size();) {
        const std::size_t end = std::min(name.find('/', start), name.size());
        const std::string_view part = name.substr(start, end - start);
        if (part == "..") return "has ..";
        if (part == ".") return "has a part that is a dot";
        if (part.empty()) return "has an empty part";
        start = end + 1;
    }
    return {};
}

}  // namespace si
