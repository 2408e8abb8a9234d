// Data URIs and relative URIs of glTF buffers and images.
#include <algorithm>
#include <array>
#include <optional>
#include <system_error>

#include "renderer/base/lower_case.h"
#include "renderer/base/percent_decoded.h"
#include "renderer/gltf/file.h"

namespace si::gltf {
namespace {

constexpr std::size_t kLongestUri = 4096;

constexpr std::array<std::int8_t, 256> base64_values() {
    std::array<std::int8_t, 256> table{};
    table.fill(-1);
    constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < kAlphabet.size(); ++i) {
        table[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::int8_t>(i);
    }
    return table;
}

std::optional<Bytes> decode_base64(std::string_view text) {
    static constexpr auto kValues = base64_values();
    if (text.size() % 4 == 0) {
        for (int i = 0; i < 2 && !text.empty() && text.back() == '='; ++i) text.remove_suffix(1);
    }
    if (text.size() % 4 == 1) return std::nullopt;
    Bytes out(text.size() / 4 * 3 + (text.size() % 4 == 0 ? 0 : text.size() % 4 - 1));
    const auto value = [&](std::size_t i) -> int { return kValues[static_cast<unsigned char>(text[i])]; };
    std::size_t written = 0;
    for (std::size_t i = 0; i < text.size(); i += 4) {
        const std::size_t n = std::min<std::size_t>(4, text.size() - i);
        const int a = value(i), b = value(i + 1), c = n > 2 ? value(i + 2) : 0, d = n > 3 ? value(i + 3) : 0;
        if ((a | b | c | d) < 0) return std::nullopt;
        const auto bits = std::uint32_t(a << 18 | b << 12 | c << 6 | d);
        out.data[written++] = static_cast<std::uint8_t>(bits >> 16);
        if (n > 2) out.data[written++] = static_cast<std::uint8_t>(bits >> 8 & 0xff);
        if (n > 3) out.data[written++] = static_cast<std::uint8_t>(bits & 0xff);
    }
    return out;
}

/// Returns true when a URI begins with a scheme (RFC 3986, section 3.1).
bool has_scheme(std::string_view uri) {
    constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz";
    const std::string scheme = lower_ascii(uri.substr(0, uri.find(':')));
    return !scheme.empty() && scheme.size() < uri.size() && kLetters.find(scheme[0]) != kLetters.npos &&
           scheme.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789+-.") == scheme.npos;
}

bool is_below(const std::filesystem::path& path, const std::filesystem::path& folder) {
    const auto [end, unused] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return end == folder.end();
}

}  // namespace

bool is_data_uri(std::string_view uri) {
    return uri.substr(0, 5) == "data:";
}

ReadResult decode_data_uri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) return {{}, "data URI without a comma"};
    constexpr std::string_view kMarker = ";base64";
    const std::string_view head = uri.substr(0, comma);
    if (head.size() < kMarker.size() || head.substr(head.size() - kMarker.size()) != kMarker) {
        return {{}, "data URI that is not base64"};
    }
    auto bytes = decode_base64(uri.substr(comma + 1));
    if (!bytes) return {{}, "data URI with broken base64"};
    return {std::move(*bytes), {}};
}

ResolvedUri resolve_uri(const std::filesystem::path& folder, std::string_view uri) {
    const auto refused = [](std::string why) { return ResolvedUri{{}, std::move(why)}; };
    if (uri.empty()) return refused("the uri is empty");
    if (uri.size() > kLongestUri) return refused("the uri is longer than 4096 bytes");
    if (has_scheme(uri)) return refused("the uri has a scheme; only relative files are read");

    const std::string decoded = percent_decode(uri);
    if (decoded.find('\0') != std::string::npos) return refused("the uri holds a NUL character");
    if (decoded.front() == '/') return refused("the uri is an absolute path");
    if (decoded.find('\\') != std::string::npos) return refused("the uri holds a backslash; write '/'");

    std::error_code error;
    const std::filesystem::path root = std::filesystem::canonical(folder.empty() ? "." : folder, error);
    if (error) return refused("the model's folder cannot be examined");
    for (const std::string& name : {decoded, std::string(uri)}) {
        const std::filesystem::path lexical = (root / name).lexically_normal();
        if (!is_below(lexical, root)) return refused("the uri leaves the model's folder");
        const std::filesystem::path real = std::filesystem::canonical(root / name, error);
        if (error) continue;
        if (!is_below(real, root)) return refused("the uri leaves the model's folder");
        return {real, {}};
    }
    return refused("the file does not exist");
}

}  // namespace si::gltf
