// Tests of map images in PNG and OpenEXR files, whole and damaged.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <half.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include "renderer/bundle/map_image.h"
#include "renderer/bundle/map_image_exr.h"
#include "renderer/bundle/map_image_png.h"
#include "tests/support/error_text.h"
#include "tests/support/process.h"

namespace si {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

std::string big_endian(std::uint32_t v) {
    return {char(v >> 24), char(v >> 16), char(v >> 8), char(v)};
}

std::string png_chunk(const std::string& name, const std::string& data) {
    std::uint32_t crc = ~0u;
    for (const char c : name + data) {
        crc ^= std::uint8_t(c);
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    return big_endian(std::uint32_t(data.size())) + name + data + big_endian(~crc);
}

/// Returns a PNG file of grey texels in stored deflate blocks. @param rows without filter bytes
std::string grey_png(std::uint32_t width, std::uint32_t height, int bits, const std::string& rows) {
    std::string filtered;
    const std::size_t across = height ? rows.size() / height : 0;
    for (std::size_t y = 0; y < height; ++y) filtered += std::string(1, '\0') + rows.substr(y * across, across);
    std::uint32_t a = 1, b = 0;
    for (const char c : filtered) {
        a = (a + std::uint8_t(c)) % 65521;
        b = (b + a) % 65521;
    }
    std::string zlib = "\x78\x01";
    for (std::size_t at = 0; at < filtered.size(); at += 65535) {
        const std::size_t size = std::min<std::size_t>(65535, filtered.size() - at);
        zlib += char(at + size == filtered.size());
        zlib += {char(size), char(size >> 8), char(~size), char(~size >> 8)};
        zlib += filtered.substr(at, size);
    }
    zlib += big_endian(b << 16 | a);
    const std::string header = big_endian(width) + big_endian(height) + std::string{char(bits), 0, 0, 0, 0};
    return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + png_chunk("IDAT", zlib) + png_chunk("IEND", "");
}

TEST(MapImagePng, SixteenBitsAreShares) {
    const std::string rows = {0, 0, char(0xff), char(0xff), 0x12, 0x34, char(0x80), 0, 0, 1, 0x7f, char(0xff)};
    const FloatImage image = decode_map_image("map.png", bytes_of(grey_png(3, 2, 16, rows)), {});
    EXPECT_EQ(image.width, 3);
    EXPECT_EQ(image.height, 2);
    EXPECT_EQ(image.channels, 1);
    const int numbers[] = {0, 65535, 0x1234, 0x8000, 1, 0x7fff};
    for (int i = 0; i < 6; ++i) EXPECT_EQ(image.at(i % 3, i / 3), float(numbers[i] / 65535.0)) << i;
}

TEST(MapImagePng, DamagedFilesEndInOneSentence) {
    const std::string whole = grey_png(3, 2, 16, std::string(12, 'x'));
    const auto fault = [](const std::string& bytes) {
        return test::error_text([&] { decode_map_image("dir/map.png", bytes_of(bytes), {}); });
    };
    EXPECT_TRUE(test::mentions(fault(""), {"dir/map.png: ", "no PNG image; "}));
    EXPECT_TRUE(test::mentions(fault("Pf\n1 1\n-1\n    "), {"no PNG image"}));
    for (std::size_t size = 8; size + 12 < whole.size(); ++size)
        EXPECT_TRUE(test::mentions(fault(whole.substr(0, size)), {"dir/map.png: ", "; "})) << size;
    EXPECT_TRUE(test::mentions(fault(grey_png(3, 2, 8, std::string(6, 'x'))), {"8 bits a channel", "16 bits"}));
    EXPECT_TRUE(test::mentions(fault(grey_png(20000, 1, 16, "")), {"20000 × 1 texels", "16384"}));
    EXPECT_TRUE(test::mentions(fault(grey_png(16384, 16384, 16, "")), {"dir/map.png: "}));
    EXPECT_NE(fault(grey_png(0, 0, 16, "")), "");
}

/// Bytes that the library writes.
struct ExrFile : Imf::OStream {
    ExrFile() : OStream("test") {}
    void write(const char c[], int n) override {
        if (bytes.size() < at + std::uint64_t(n)) bytes.resize(at + std::uint64_t(n));
        std::memcpy(bytes.data() + at, c, std::size_t(n));
        at += std::uint64_t(n);
    }
    std::uint64_t tellp() override { return at; }
    void seekp(std::uint64_t place) override { at = place; }
    std::string bytes;
    std::uint64_t at = 0;
};

/// Returns an OpenEXR file of 37 x 21 texels with a data window off the origin: R half, Z float, id uint.
std::string exr_file(bool tiled, Imf::Compression compression) {
    constexpr int kWidth = 37, kHeight = 21;
    const Imath::Box2i window({-5, 7}, {-5 + kWidth - 1, 7 + kHeight - 1});
    Imf::Header header(Imath::Box2i({0, 0}, {63, 63}), window);
    header.compression() = compression;
    header.channels().insert("R", Imf::Channel(Imf::HALF));
    header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
    header.channels().insert("id", Imf::Channel(Imf::UINT));
    std::vector<half> r;
    std::vector<float> z;
    std::vector<std::uint32_t> id;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            r.emplace_back(float(x) / 64);
            z.push_back(float(x + 100 * y) / 3);
            id.push_back(std::uint32_t(y) << 27);
        }
    Imf::FrameBuffer buffer;
    const auto add = [&](const char* name, Imf::PixelType type, auto& data) {
        const std::size_t size = sizeof data[0];
        char* origin = reinterpret_cast<char*>(data.data()) + (5 - 7 * kWidth) * std::ptrdiff_t(size);
        buffer.insert(name, Imf::Slice(type, origin, size, size * kWidth));
    };
    add("R", Imf::HALF, r);
    add("Z", Imf::FLOAT, z);
    add("id", Imf::UINT, id);
    ExrFile stream;
    if (tiled) {
        header.setTileDescription(Imf::TileDescription(16, 16));
        Imf::TiledOutputFile file(stream, header, 0);
        file.setFrameBuffer(buffer);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    } else {
        Imf::OutputFile file(stream, header, 0);
        file.setFrameBuffer(buffer);
        file.writePixels(kHeight);
    }
    return stream.bytes;
}

TEST(MapImageExr, ScanlinesAndTilesOfAllTypesAreRead) {
    for (const bool tiled : {false, true})
        for (const auto compression : {Imf::NO_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
            const FloatImage image = decode_map_image("map.exr", bytes_of(exr_file(tiled, compression)), {});
            ASSERT_EQ(image.width, 37);
            ASSERT_EQ(image.height, 21);
            ASSERT_EQ(image.channels, 3) << "Z, R, id";
            for (int y = 0; y < 21; ++y)
                for (int x = 0; x < 37; ++x) {
                    ASSERT_EQ(image.at(x, y, 0), float(x + 100 * y) / 3);
                    ASSERT_EQ(image.at(x, y, 1), float(x) / 64);
                    ASSERT_EQ(image.at(x, y, 2), float((std::uint32_t(y) << 27) / 4294967295.0));
                }
        }
}

TEST(MapImageExr, OwnFilesKeepEachBit) {
    FloatImage image{5, 3, 2, {}};
    for (int i = 0; i < 30; ++i) image.data.push_back(i % 7 == 3 ? INFINITY : std::sqrt(float(i)) / 7);
    const std::string bytes = exr_bytes(image);
    EXPECT_EQ(bytes, exr_bytes(image));
    const FloatImage read = decode_map_image("map.exr", bytes_of(bytes), {});
    ASSERT_EQ(read.width, 5);
    ASSERT_EQ(read.height, 3);
    ASSERT_EQ(read.channels, 1);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x) EXPECT_EQ(read.at(x, y), image.at(x, y, 0));
}

TEST(MapImageExr, DamagedFilesEndInOneSentence) {
    const auto fault = [](const std::string& bytes) {
        return test::error_text([&] { decode_map_image("dir/map.exr", bytes_of(bytes), {}); });
    };
    EXPECT_TRUE(test::mentions(fault(""), {"dir/map.exr: ", "no OpenEXR image; "}));
    const std::string whole = exr_file(false, Imf::ZIP_COMPRESSION);
    for (const std::size_t size : {4ul, 9ul, 60ul, 250ul, whole.size() / 2, whole.size() - 1})
        EXPECT_TRUE(test::mentions(fault(whole.substr(0, size)), {"dir/map.exr: ", "; "})) << size;
    // A data window of some 2^31 texels across.
    std::string huge = whole;
    const std::size_t place = huge.find("box2i", huge.find("dataWindow")) + 6 + 4 + 8;
    huge.replace(place, 4, std::string("\xff\xff\xff\x7f", 4));
    EXPECT_TRUE(test::mentions(fault(huge), {"dir/map.exr: "}));
    std::string large = whole;
    large.replace(place, 8, std::string("\x00\x40\x00\x00\x00\x40\x00\x00", 8));
    EXPECT_TRUE(test::mentions(fault(large), {"dir/map.exr: "}));
    // Each byte of the header and the start of the data changed: an image or a sentence.
    for (std::size_t i = 4; i < std::min<std::size_t>(whole.size(), 400); i += 13) {
        std::string damaged = whole;
        damaged[i] = char(damaged[i] ^ 0x5a);
        const std::string text = fault(damaged);
        EXPECT_TRUE(text.empty() || text.starts_with("dir/map.exr: ")) << i << " " << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace si
