#include "renderer/bundle/map_image_png.h"

#include <fmt/format.h>
#include <stb/stb_image.h>

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>

#include "renderer/base/error.h"
#include "renderer/bundle/map_image_checks.h"
#include "renderer/gltf/image_faults.h"

namespace si {
namespace {

[[noreturn]] void refuse_png(std::string_view what, std::string_view fix) {
    throw Error(fmt::format("{}; {}", what, fix));
}

}  // namespace

FloatImage decode_png_map(std::span<const std::byte> bytes) {
    constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!text.starts_with(kSignature)) refuse_png("the file is no PNG image", "write a PNG file of 16 bits");
    if (bytes.size() > std::size_t(std::numeric_limits<int>::max()))
        refuse_png("the file exceeds 2 GiB", "use a .raw file");
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = int(bytes.size());
    const auto fault = [&] { return gltf::image_fault({data, bytes.size()}); };
    int width = 0, height = 0, channels = 0;
    if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) refuse_png(fault(), "write the file again");
    check_map_image_sides(width, height);
    if (stbi_is_16_bit_from_memory(data, size) == 0)
        refuse_png("the PNG has 8 bits a channel, too few for depths", "write a PNG file of 16 bits");
    // stb_image computes sizes as int: two bytes a number, and rows with their filter bytes.
    constexpr std::size_t kMaxNumbers = std::size_t(std::numeric_limits<int>::max()) / 4;
    check_map_image_numbers(width, height, channels, kMaxNumbers);
    const std::unique_ptr<stbi_us, decltype(&std::free)> decoded(
        stbi_load_16_from_memory(data, size, &width, &height, &channels, 0), &std::free);
    if (!decoded) refuse_png(fault(), "write the file again");
    if (const std::string damage = gltf::checksum_fault({data, bytes.size()}); !damage.empty())
        refuse_png(damage, "write the file again");
    FloatImage out{width, height, channels, {}};
    out.data.resize(std::size_t(width) * std::size_t(height) * std::size_t(channels));
    for (std::size_t i = 0; i < out.data.size(); ++i) out.data[i] = float(decoded.get()[i] / 65535.0);
    return out;
}

}  // namespace si
