#include "renderer/gltf/image_decode.h"

#include <fmt/format.h>
#include <stb/stb_image.h>

#include <cstdlib>
#include <limits>
#include <memory>

#include "renderer/gltf/image_faults.h"

namespace si::gltf {
namespace {

std::string kind_of(std::span<const std::uint8_t> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.substr(0, 8) == std::string_view("\xABKTX 20\xBB")) return "KTX2";
    return "";
}

}  // namespace

std::size_t decoding_bytes(std::span<const std::uint8_t> bytes) {
    if (bytes.size() > std::size_t(std::numeric_limits<int>::max())) return 0;
    int width = 0, height = 0, channels = 0;
    const int size = int(bytes.size());
    if (stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) == 0 || width <= 0 || height <= 0)
        return 0;
    // stb keeps filtered rows and converted pixels at once; 16-bit files take twice as much and an 8-bit copy.
    const std::size_t per_pixel = stbi_is_16_bit_from_memory(bytes.data(), size) != 0 ? 20 : 12;
    return std::size_t(width) * std::size_t(height) * per_pixel;
}

Image decode_image(std::span<const std::uint8_t> bytes) {
    const auto refused = [](std::string why) { return Image{0, 0, {}, std::move(why)}; };
    if (const std::string kind = kind_of(bytes); !kind.empty()) {
        return refused(fmt::format("{} images are not supported, use PNG or JPEG", kind));
    }
    if (bytes.size() > std::size_t(std::numeric_limits<int>::max())) return refused("the file exceeds 2 GiB");

    Image out;
    int channels = 0;
    const int bytes_size = int(bytes.size());
    if (stbi_info_from_memory(bytes.data(), bytes_size, &out.width, &out.height, &channels) == 0)
        return refused(image_fault(bytes));
    constexpr int kMostAcross = 32768;
    constexpr std::size_t kMostPixels = std::size_t(std::numeric_limits<int>::max()) / 4;  // of stb_image
    if (out.width > kMostAcross || out.height > kMostAcross ||
        std::size_t(out.width) * std::size_t(out.height) > kMostPixels)
        return refused(fmt::format("{} x {} pixels, at most {} each way and {} in all are read; use a smaller one",
                                   out.width, out.height, kMostAcross, kMostPixels));
    const std::unique_ptr<stbi_uc, decltype(&std::free)> decoded(
        stbi_load_from_memory(bytes.data(), bytes_size, &out.width, &out.height, &channels, STBI_rgb_alpha),
        &std::free);
    if (!decoded) return refused(image_fault(bytes));
    if (out.width <= 0 || out.height <= 0) return refused(fmt::format("{} x {} pixels", out.width, out.height));
    const std::size_t size = std::size_t(out.width) * std::size_t(out.height) * 4;
    out.rgba.assign(decoded.get(), decoded.get() + size);
    return out;
}

}  // namespace si::gltf
