#include "renderer/bundle/map_image.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "renderer/base/error.h"
#include "renderer/base/lower_case.h"
#include "renderer/base/printable.h"
#include "renderer/bundle/map_image_checks.h"
#include "renderer/bundle/map_image_exr.h"
#include "renderer/bundle/map_image_png.h"

namespace si {
namespace {

static_assert(std::endian::native == std::endian::little, "texels are copied as they lie in the file");

constexpr std::size_t kMaxNumbers = std::size_t{1} << 29;

[[noreturn]] void refuse_image(std::string_view what, std::string_view fix) {
    throw Error(fmt::format("{}; {}", what, fix));
}

/// Returns the next word of the header of a PFM file and moves behind the blank that ends it; empty at its end.
std::string_view next_word(std::string_view& rest) {
    constexpr std::size_t kLongest = 32;
    const std::size_t end = rest.substr(0, kLongest).find_first_of(" \t\r\n");
    if (end == rest.npos || end == 0) return {};
    const std::string_view word = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    return word;
}

template <typename T>
bool parse_whole(std::string_view word, T& out) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), out);
    return error == std::errc() && end == word.data() + word.size();
}

FloatImage decode_pfm(std::span<const std::byte> bytes) {
    constexpr std::string_view kFix = "write a PFM file: Pf, width and height, -1.0, floats";
    std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string_view magic = next_word(rest);
    long width = 0, height = 0;
    double scale = 0;
    if (magic != "Pf" && magic != "PF") refuse_image("the file is no PFM image", kFix);
    if (!parse_whole(next_word(rest), width) || !parse_whole(next_word(rest), height) ||
        !parse_whole(next_word(rest), scale) || !std::isfinite(scale) || scale == 0)
        refuse_image("the header of the PFM image cannot be read", kFix);
    FloatImage out{0, 0, magic == "PF" ? 3 : 1, {}};
    check_map_image_sides(width, height);
    check_map_image_numbers(width, height, out.channels, kMaxNumbers);
    out.width = int(width);
    out.height = int(height);
    const std::size_t count = std::size_t(width) * std::size_t(height) * std::size_t(out.channels);
    if (rest.size() != count * sizeof(float))
        refuse_image(fmt::format("{} bytes follow the header and {} are needed", rest.size(), count * sizeof(float)),
                     "write the file again");
    out.data.resize(count);
    std::memcpy(out.data.data(), rest.data(), rest.size());
    if (scale > 0)  // big-endian
        for (float& v : out.data) v = std::bit_cast<float>(__builtin_bswap32(std::bit_cast<std::uint32_t>(v)));
    return out;
}

/// Returns one number of a raw image from its bytes.
float raw_number(RawFormat format, const std::byte* at) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, at, format == RawFormat::F16 || format == RawFormat::U16 ? 2 : 4);
    switch (format) {
        case RawFormat::F32:
            return std::bit_cast<float>(bits);
        case RawFormat::F16:
            return glm::unpackHalf1x16(std::uint16_t(bits));
        case RawFormat::U16:
            return float(bits / 65535.0);
        case RawFormat::U24:
            return float((bits & 0xffffff) / 16777215.0);
        case RawFormat::U32:
            return float(bits / 4294967295.0);
    }
    return 0;
}

FloatImage decode_raw(std::span<const std::byte> bytes, const MapImageFormat& raw) {
    if (!raw.format) refuse_image("the format of the raw image is unknown", "state format, width, height");
    if (raw.channels < 1 || raw.channels > 4)
        refuse_image(fmt::format("{} channels cannot be read", raw.channels), "use 1 to 4");
    check_map_image_sides(raw.width, raw.height);
    check_map_image_numbers(raw.width, raw.height, raw.channels, kMaxNumbers);
    const std::size_t each = *raw.format == RawFormat::F16 || *raw.format == RawFormat::U16 ? 2 : 4;
    FloatImage out{raw.width, raw.height, raw.channels, {}};
    const std::size_t count = std::size_t(raw.width) * std::size_t(raw.height) * std::size_t(raw.channels);
    if (bytes.size() != count * each)
        refuse_image(fmt::format("the file has {} bytes, and {} × {} texels of {} bytes make {}", bytes.size(),
                                 raw.width, raw.height, each * std::size_t(raw.channels), count * each),
                     "correct width, height, channels or format");
    out.data.resize(count);
    for (std::size_t i = 0; i < count; ++i) out.data[i] = raw_number(*raw.format, bytes.data() + i * each);
    return out;
}

FloatImage decode_by_extension(std::string_view file_name, std::span<const std::byte> bytes,
                               const MapImageFormat& raw) {
    const std::string extension = lower_extension(file_name);
    if (extension == ".pfm") return decode_pfm(bytes);
    if (extension == ".raw") return decode_raw(bytes, raw);
    if (extension == ".png") return decode_png_map(bytes);
    if (extension == ".exr") return decode_exr_map(bytes);
    refuse_image("the format of the image is not read", "use a .pfm, .exr, .png or .raw file");
}

}  // namespace

FloatImage decode_map_image(std::string_view file_name, std::span<const std::byte> bytes, const MapImageFormat& raw) {
    try {
        return decode_by_extension(file_name, bytes, raw);
    } catch (const Error& error) {
        throw Error(fmt::format("{}: {}", printable(file_name, 300), error.what()));
    }
}

}  // namespace si
