#include "renderer/gltf/image_faults.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <string_view>

#include "renderer/base/printable.h"

namespace si::gltf {
namespace {

constexpr std::string_view kPngSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::size_t kAroundChunk = 12;  ///< bytes of length, type and checksum of a PNG's chunk

/// Big-endian reader of a file in memory.
struct ByteReader {
    std::span<const std::uint8_t> all;

    std::size_t left(std::size_t at) const { return at < all.size() ? all.size() - at : 0; }
    std::uint32_t u8(std::size_t at) const { return all[at]; }
    std::uint32_t u16(std::size_t at) const { return u8(at) << 8 | u8(at + 1); }
    std::uint32_t u32(std::size_t at) const { return u16(at) << 16 | u16(at + 2); }
    std::string_view text(std::size_t at, std::size_t count) const {
        return {reinterpret_cast<const char*>(all.data()) + at, std::min(count, left(at))};
    }
};

/// Returns the fault of a PNG's header IHDR, whose data starts at `at`; empty: none.
std::string header_fault(const ByteReader& png, std::size_t at) {
    const std::uint32_t width = png.u32(at), height = png.u32(at + 4), depth = png.u8(at + 8), type = png.u8(at + 9);
    if (width == 0 || height == 0) return fmt::format("the PNG has {} x {} pixels", width, height);
    const bool is_type = type == 0 || type == 2 || type == 3 || type == 4 || type == 6;
    const bool is_small = (depth == 1 || depth == 2 || depth == 4) && (type == 0 || type == 3);
    if (!is_type || !(is_small || depth == 8 || (depth == 16 && type != 3)))
        return fmt::format("the PNG has bit depth {} and colour type {}, which do not exist together", depth, type);
    if (png.u8(at + 10) != 0 || png.u8(at + 11) != 0 || png.u8(at + 12) > 1)
        return "the PNG has an unknown compression, filter or interlace method";
    return "";
}

std::string png_fault(const ByteReader& png) {
    if (png.text(0, 8) != kPngSignature) return "the PNG's signature is cut or damaged";
    bool has_data = false, has_palette = false, needs_palette = false;
    for (std::size_t at = 8;;) {
        if (png.left(at) < kAroundChunk) return "the PNG is cut before its end (IEND)";
        const std::size_t length = png.u32(at);
        const std::string_view type = png.text(at + 4, 4);
        if (length > png.left(at) - kAroundChunk)
            return fmt::format("the PNG is cut or damaged inside its chunk {}", printable(type));
        if (at == 8) {
            if (type != "IHDR" || length != 13) return "the PNG does not begin with a header (IHDR)";
            if (std::string fault = header_fault(png, at + 8); !fault.empty()) return fault;
            needs_palette = png.u8(at + 17) == 3;
        }
        has_palette |= type == "PLTE";
        has_data |= type == "IDAT" && length > 0;
        if (type == "IEND") break;
        at += kAroundChunk + length;
    }
    if (!has_data) return "the PNG has no image data (IDAT)";
    if (needs_palette && !has_palette) return "the PNG has no palette (PLTE)";
    return "the PNG's compressed data is damaged";
}

/// Returns the fault of a JPEG's frame header (SOF), whose data has `length` bytes from `at`; empty: none.
std::string frame_fault(const ByteReader& jpeg, std::size_t at, std::size_t length, std::uint32_t marker) {
    if (marker > 0xc2)
        return "the JPEG is lossless, hierarchical or arithmetic; only baseline and progressive are read";
    if (length < 6 || length != 6 + 3 * std::size_t(jpeg.u8(at + 5))) return "the JPEG's frame header (SOF) is damaged";
    if (jpeg.u8(at) != 8) return fmt::format("the JPEG has {} bits a sample; only 8 are read", jpeg.u8(at));
    if (jpeg.u16(at + 1) == 0 || jpeg.u16(at + 3) == 0)
        return fmt::format("the JPEG has {} x {} pixels", jpeg.u16(at + 3), jpeg.u16(at + 1));
    return "";
}

/// Returns the fault of a JPEG's first scan header (SOS); empty: none. @param frame data of the frame header
std::string scan_fault(const ByteReader& jpeg, std::size_t at, std::size_t length,
                       std::span<const std::uint8_t> frame) {
    if (frame.empty()) return "the JPEG's scan (SOS) has no frame header (SOF) before it";
    if (length < 4 || length != 4 + 2 * std::size_t(jpeg.u8(at))) return "the JPEG's scan header (SOS) is damaged";
    for (std::size_t i = 0; i < jpeg.u8(at); ++i) {
        const std::uint32_t component = jpeg.u8(at + 1 + 2 * i);
        bool is_known = false;
        for (std::size_t k = 6; k < frame.size(); k += 3) is_known |= frame[k] == component;
        if (!is_known) return fmt::format("the JPEG's scan names component {}, which its frame lacks", component);
    }
    return "";
}

std::string jpeg_fault(const ByteReader& jpeg) {
    std::span<const std::uint8_t> frame;
    for (std::size_t at = 2;;) {
        if (jpeg.left(at) < 2) return "the JPEG is cut before its image data";
        if (jpeg.u8(at) != 0xff) return fmt::format("the JPEG has no marker at byte {}, where one must be", at);
        const std::uint32_t marker = jpeg.u8(at + 1);
        if (marker == 0xff) {  // a byte that fills
            ++at;
            continue;
        }
        if (marker == 0xd9) return "the JPEG ends before its image data";
        at += 2;
        if (marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8)) continue;  // these have no data
        if (jpeg.left(at) < 2) return "the JPEG is cut before its image data";
        const std::size_t length = jpeg.u16(at);
        if (length < 2 || length > jpeg.left(at))
            return fmt::format("the JPEG is cut or damaged inside its segment {:02X}", marker);
        const bool is_frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (is_frame) {
            if (std::string fault = frame_fault(jpeg, at + 2, length - 2, marker); !fault.empty()) return fault;
            frame = jpeg.all.subspan(at + 2, length - 2);
        }
        if (marker == 0xda) {
            std::string fault = scan_fault(jpeg, at + 2, length - 2, frame);
            return fault.empty() ? "the JPEG's compressed data is damaged" : fault;
        }
        at += length;
    }
}

}  // namespace

std::string image_fault(std::span<const std::uint8_t> bytes) {
    const ByteReader file{bytes};
    if (bytes.empty()) return "the image is empty";
    if (file.text(0, 4) == kPngSignature.substr(0, 4)) return png_fault(file);
    if (file.text(0, 2) == "\xff\xd8") return jpeg_fault(file);
    return "the file is neither a PNG nor a JPEG image";
}

std::string checksum_fault(std::span<const std::uint8_t> bytes) {
    const ByteReader png{bytes};
    if (png.text(0, 8) != kPngSignature) return "";
    for (std::size_t at = 8; png.left(at) >= kAroundChunk;) {
        const std::size_t length = png.u32(at);
        if (length > png.left(at) - kAroundChunk) break;
        const std::string_view type = png.text(at + 4, 4);
        // Pixels depend on critical chunks, whose names begin with a capital letter, and on transparency.
        const bool is_critical = (type[0] & 0x20) == 0 || type == "tRNS";
        if (is_critical && crc32(0, &bytes[at + 4], uInt(4 + length)) != png.u32(at + 8 + length))
            return fmt::format("the PNG is damaged inside its chunk {} (wrong checksum)", printable(type));
        if (type == "IEND") break;
        at += kAroundChunk + length;
    }
    return "";
}

}  // namespace si::gltf
