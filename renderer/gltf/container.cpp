#include "renderer/gltf/container.h"

#include <fmt/format.h>

namespace si::gltf {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67, kJson = 0x4E4F534A, kBin = 0x004E4942;
constexpr std::string_view kExportAgain = "the file is cut or damaged, export or copy it again";

std::uint32_t u32_at(std::span<const std::uint8_t> bytes, std::size_t at) {
    return std::uint32_t(bytes[at]) | std::uint32_t(bytes[at + 1]) << 8 | std::uint32_t(bytes[at + 2]) << 16 |
           std::uint32_t(bytes[at + 3]) << 24;
}

std::string_view as_text(std::span<const std::uint8_t> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

Container split_container(Context& context, std::span<const std::uint8_t> file) {
    Container out;
    if (file.empty()) context.fail("the file is empty", kExportAgain);
    if (file.size() < 4 || u32_at(file, 0) != kMagic) {
        std::string_view text = as_text(file);
        if (text.substr(0, 3) == "\xef\xbb\xbf") text.remove_prefix(3);
        const std::size_t first = text.find_first_not_of(" \t\r\n");
        if (first == std::string_view::npos || (text[first] != '{' && text[first] != '[')) {
            context.fail("this is neither glTF JSON (UTF-8) nor GLB", "open a .gltf or .glb file");
        }
        out.json = text;
        return out;
    }

    if (file.size() < 20) context.fail("the GLB header is cut", kExportAgain);
    const std::uint32_t version = u32_at(file, 4), total = u32_at(file, 8);
    if (version != 2) {
        context.fail(fmt::format("GLB version {} is not supported", version), "convert the model to glTF 2.0");
    }
    if (total > file.size() || total < 20) {
        context.fail(fmt::format("the GLB header states {} bytes but the file has {}", total, file.size()),
                     kExportAgain);
    }
    if (total < file.size())
        context.warn(fmt::format("{} bytes after the end of the GLB are ignored", file.size() - total));

    std::size_t at = 12;
    for (std::size_t chunk = 0; total - at >= 8; ++chunk) {
        const std::size_t length = u32_at(file, at);
        const std::uint32_t type = u32_at(file, at + 4);
        const std::size_t left = total - at - 8;
        if (length > left) {
            context.fail(Place("chunk", chunk), fmt::format("states {} bytes, only {} are left", length, left),
                         kExportAgain);
        }
        const auto body = file.subspan(at + 8, length);
        if (chunk == 0) {
            if (type != kJson) context.fail(Place("chunk", 0), "is not JSON, which must come first", kExportAgain);
            out.json = as_text(body);
        } else if (chunk == 1 && type == kBin) {
            out.bin = body;
            out.has_bin = true;
        }
        at += 8 + length;
    }
    // Some exporters pad with NUL instead of spaces.
    while (!out.json.empty() && out.json.back() == '\0') out.json.remove_suffix(1);
    return out;
}

}  // namespace si::gltf
