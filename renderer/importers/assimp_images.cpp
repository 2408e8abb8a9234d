#include "renderer/importers/assimp_images.h"

#include <fmt/format.h>
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string_view>

namespace si::assimp {
namespace {

constexpr int kMaxSide = 16384;

/// Decoded image, RGBA8, row 0 at the top.
struct Pixels {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
    bool has_alpha() const {
        for (std::size_t i = 3; i < rgba.size(); i += 4)
            if (rgba[i] < 255) return true;
        return false;
    }
};

bool starts_with(std::span<const std::uint8_t> bytes, std::string_view magic) {
    return bytes.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin(),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

bool is_png_or_jpeg(std::span<const std::uint8_t> bytes) {
    return starts_with(bytes, "\x89PNG") || starts_with(bytes, "\xff\xd8\xff");
}

std::optional<Pixels> decode(std::span<const std::uint8_t> bytes, std::string& why) {
    Pixels out;
    int channels = 0;
    const auto size = int(std::min<std::size_t>(bytes.size(), std::size_t(std::numeric_limits<int>::max())));
    if (!stbi_info_from_memory(bytes.data(), size, &out.width, &out.height, &channels)) {
        why = "it is no PNG, JPEG, TGA, BMP, GIF or PSD image; convert it to PNG";
        return std::nullopt;
    }
    if (out.width > kMaxSide || out.height > kMaxSide) {
        why = fmt::format("it has {} x {} pixels, at most {} each way are read", out.width, out.height, kMaxSide);
        return std::nullopt;
    }
    const std::unique_ptr<stbi_uc, decltype(&std::free)> decoded(
        stbi_load_from_memory(bytes.data(), size, &out.width, &out.height, &channels, STBI_rgb_alpha), &std::free);
    if (!decoded) {
        why = "the image is damaged";
        return std::nullopt;
    }
    out.rgba.assign(decoded.get(), decoded.get() + std::size_t(out.width) * std::size_t(out.height) * 4);
    return out;
}

void append_encoded(void* out, void* data, int size) {
    auto& bytes = *static_cast<std::vector<std::uint8_t>*>(out);
    const auto* from = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), from, from + size);
}

std::vector<std::uint8_t> encode(const Pixels& pixels) {
    std::vector<std::uint8_t> out;
    if (!stbi_write_png_to_func(append_encoded, &out, pixels.width, pixels.height, 4, pixels.rgba.data(),
                                4 * pixels.width))
        throw std::bad_alloc();
    return out;
}

/// Encodes an embedded image that Assimp has decoded.
std::vector<std::uint8_t> encode(const aiTexture& texture) {
    Pixels pixels{int(texture.mWidth), int(texture.mHeight), {}};
    const std::size_t count = std::size_t(texture.mWidth) * texture.mHeight;
    for (std::size_t i = 0; i < count; ++i) {
        const aiTexel& t = texture.pcData[i];
        pixels.rgba.insert(pixels.rgba.end(), {t.r, t.g, t.b, t.a});
    }
    return encode(pixels);
}

/// Returns the texel of an image that covers texel (x, y) of an image of another size.
std::size_t texel_at(const Pixels& image, int x, int y, const Pixels& other) {
    const auto column = std::size_t(std::int64_t(x) * image.width / other.width);
    const auto row = std::size_t(std::int64_t(y) * image.height / other.height);
    return 4 * (row * std::size_t(image.width) + column);
}

}  // namespace

std::optional<std::vector<std::uint8_t>> Images::file(const std::string& path, std::string& why) const {
    if (const aiTexture* const texture = scene_.GetEmbeddedTexture(path.c_str())) {
        if (texture->mHeight > 0) return encode(*texture);
        const auto* const bytes = reinterpret_cast<const std::uint8_t*>(texture->pcData);
        return std::vector<std::uint8_t>(bytes, bytes + texture->mWidth);
    }
    // Many models name files by the path on the machine of their author.
    const std::string name = path.substr(path.find_last_of("/\\") + 1);
    for (const std::string& place : {path, name, "textures/" + name})
        if (auto bytes = folder_.read(place)) return bytes;
    why = "there is no such file in the model's folder";
    return std::nullopt;
}

std::optional<EncodedImage> Images::colour(const std::string& path, std::string& why) const {
    auto bytes = file(path, why);
    if (!bytes) return std::nullopt;
    if (is_png_or_jpeg(*bytes)) return EncodedImage{std::move(*bytes), false};
    const auto pixels = decode(*bytes, why);
    if (!pixels) return std::nullopt;
    return EncodedImage{encode(*pixels), false};
}

std::optional<EncodedImage> Images::masked(const std::string& path, const std::string& opacity_path,
                                           std::string& why) const {
    const auto opacity_bytes = file(opacity_path, why);
    if (!opacity_bytes) return std::nullopt;
    const auto opacity = decode(*opacity_bytes, why);
    if (!opacity) return std::nullopt;
    const bool by_alpha = opacity->has_alpha();
    if (path == opacity_path) {
        // An image without transparent texels that is its own mask hides nothing.
        if (!is_png_or_jpeg(*opacity_bytes)) return EncodedImage{encode(*opacity), by_alpha};
        return EncodedImage{*opacity_bytes, by_alpha};
    }
    Pixels colour{1, 1, {255, 255, 255, 255}};
    if (!path.empty()) {
        const auto bytes = file(path, why);
        if (!bytes) return std::nullopt;
        auto pixels = decode(*bytes, why);
        if (!pixels) return std::nullopt;
        colour = std::move(*pixels);
    }
    const bool opacity_is_finer =
        std::int64_t(opacity->width) * opacity->height > std::int64_t(colour.width) * colour.height;
    const Pixels& size = opacity_is_finer ? *opacity : colour;
    Pixels out{size.width, size.height, {}};
    out.rgba.resize(size.rgba.size());
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x) {
            std::uint8_t* const to = &out.rgba[texel_at(out, x, y, out)];
            const std::uint8_t* const from = &colour.rgba[texel_at(colour, x, y, out)];
            const std::uint8_t* const mask = &opacity->rgba[texel_at(*opacity, x, y, out)];
            std::copy(from, from + 3, to);
            to[3] = by_alpha ? mask[3] : std::uint8_t((mask[0] * 54 + mask[1] * 183 + mask[2] * 19) / 256);
        }
    return EncodedImage{encode(out), out.has_alpha()};
}

}  // namespace si::assimp
