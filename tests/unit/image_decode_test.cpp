// Tests of reading PNG and JPEG files: damaged ones end in a reason of their own.
#include <gtest/gtest.h>
#include <stb/stb_image_write.h>

#include <random>
#include <set>
#include <thread>

#include "renderer/gltf/textures.h"

namespace si::test::image_decode {
namespace {

using Bytes = std::vector<std::uint8_t>;

void append(void* out, void* data, int size) {
    const auto* const bytes = static_cast<const std::uint8_t*>(data);
    static_cast<Bytes*>(out)->insert(static_cast<Bytes*>(out)->end(), bytes, bytes + size);
}

/// Returns 24 x 16 RGBA pixels of a gradient with noise.
Bytes pixels() {
    std::mt19937 random(1);
    Bytes out;
    for (int i = 0; i < 24 * 16 * 4; ++i) out.push_back(std::uint8_t(i % 4 == 3 ? 255 : i / 8 + int(random() % 32)));
    return out;
}
Bytes png() {
    Bytes out;
    stbi_write_png_to_func(append, &out, 24, 16, 4, pixels().data(), 24 * 4);
    return out;
}
Bytes jpeg() {
    Bytes out;
    stbi_write_jpg_to_func(append, &out, 24, 16, 4, pixels().data(), 80);
    return out;
}

/// Returns the position behind the first occurrence of a text.
std::size_t behind(const Bytes& bytes, std::string_view text) {
    const auto same = [](std::uint8_t byte, char c) { return byte == std::uint8_t(c); };
    return std::size_t(std::search(bytes.begin(), bytes.end(), text.begin(), text.end(), same) - bytes.begin()) +
           text.size();
}
Bytes with_byte(Bytes bytes, std::size_t at, std::uint8_t value) {
    bytes[at] = value;
    return bytes;
}
Bytes cut(Bytes bytes, std::size_t size) {
    bytes.resize(size);
    return bytes;
}
/// Returns the reason of a fresh thread, in which stb_image has none yet.
std::string error_of(const Bytes& bytes) {
    std::string error;
    std::thread([&] { error = gltf::decode_image(bytes).error; }).join();
    return error;
}

TEST(ImageDecode, WholeFilesAreDecoded) {
    EXPECT_EQ(gltf::decode_image(png()).rgba, pixels());
    const gltf::Image image = gltf::decode_image(jpeg());
    EXPECT_EQ(image.error, "");
    EXPECT_EQ(image.width, 24);
}

TEST(ImageDecode, EachFaultOfAPngHasItsReason) {
    const Bytes whole = png();
    const std::size_t header = behind(whole, "IHDR"), data = behind(whole, "IDAT");
    EXPECT_EQ(error_of(with_byte(whole, data + 2, 0x07)), "the PNG's compressed data is damaged");  // reserved block
    EXPECT_EQ(error_of(with_byte(whole, 5, 'x')), "the PNG's signature is cut or damaged");
    EXPECT_EQ(error_of(cut(whole, data + 20)), "the PNG is cut or damaged inside its chunk IDAT");
    EXPECT_EQ(error_of(cut(whole, data - 8)), "the PNG is cut before its end (IEND)");
    EXPECT_EQ(error_of(with_byte(whole, header + 3, 0)), "the PNG has 0 x 16 pixels");
    EXPECT_EQ(error_of(with_byte(whole, header + 8, 3)),
              "the PNG has bit depth 3 and colour type 6, which do not exist together");
    EXPECT_EQ(error_of(with_byte(whole, header + 12, 7)),
              "the PNG has an unknown compression, filter or interlace method");
    EXPECT_EQ(error_of(with_byte(whole, header - 1, 'x')), "the PNG does not begin with a header (IHDR)");
    EXPECT_EQ(error_of(with_byte(whole, data - 1, 't')), "the PNG has no image data (IDAT)");  // an optional chunk IDAt
    EXPECT_EQ(error_of(with_byte(whole, header + 9, 3)), "the PNG has no palette (PLTE)");
}

TEST(ImageDecode, EachFaultOfAJpegHasItsReason) {
    const Bytes whole = jpeg();
    const std::size_t frame = behind(whole, "\xff\xc0"), scan = behind(whole, "\xff\xda");
    EXPECT_EQ(error_of(with_byte(whole, scan + 3, 9)), "the JPEG's scan names component 9, which its frame lacks");
    EXPECT_EQ(error_of(with_byte(whole, frame - 1, 0xc9)),
              "the JPEG is lossless, hierarchical or arithmetic; only baseline and progressive are read");
    EXPECT_EQ(error_of(with_byte(whole, frame + 2, 12)), "the JPEG has 12 bits a sample; only 8 are read");
    EXPECT_EQ(error_of(with_byte(whole, frame + 6, 0)), "the JPEG has 0 x 16 pixels");
    EXPECT_EQ(error_of(with_byte(whole, frame + 7, 9)), "the JPEG's frame header (SOF) is damaged");
    EXPECT_EQ(error_of(cut(whole, frame + 4)), "the JPEG is cut or damaged inside its segment C0");
    EXPECT_EQ(error_of(cut(whole, 2)), "the JPEG is cut before its image data");
    EXPECT_EQ(error_of(with_byte(whole, 2, 0)), "the JPEG has no marker at byte 2, where one must be");
    EXPECT_EQ(error_of(with_byte(whole, frame - 1, 0xe5)), "the JPEG's scan (SOS) has no frame header (SOF) before it");
    EXPECT_EQ(error_of(Bytes{0xff, 0xd8, 0xff, 0xd9}), "the JPEG ends before its image data");
}

TEST(ImageDecode, OtherFilesAreNamed) {
    EXPECT_EQ(error_of({}), "the image is empty");
    EXPECT_EQ(error_of({'h', 'e', 'l', 'l', 'o'}), "the file is neither a PNG nor a JPEG image");
}

TEST(ImageDecode, DamagedFilesNeverGetTheReasonOfAnother) {
    std::vector<Bytes> files;
    std::mt19937 random(7);
    for (int i = 0; i < 600; ++i) {
        Bytes bytes = i % 2 ? jpeg() : png();
        for (std::size_t n = 1 + random() % 4; n > 0; --n)
            bytes[2 + random() % (bytes.size() - 2)] = std::uint8_t(random());
        if (random() % 4 == 0) bytes.resize(2 + random() % (bytes.size() - 2));
        files.push_back(std::move(bytes));
    }
    std::vector<std::string> alone(files.size()), together(files.size());
    for (std::size_t i = 0; i < files.size(); ++i) alone[i] = error_of(files[i]);
    const auto decode_some = [&](std::size_t first) {
        for (std::size_t i = first; i < files.size(); i += 4) together[i] = gltf::decode_image(files[i]).error;
    };
    std::vector<std::thread> threads;
    for (std::size_t first = 0; first < 4; ++first) threads.emplace_back(decode_some, first);
    for (std::thread& thread : threads) thread.join();
    // stb_image reads parts of its tables that damaged data leaves unset: a file may decode one time and not another.
    for (std::size_t i = 0; i < files.size(); ++i)
        if (!together[i].empty() && !alone[i].empty()) {
            EXPECT_EQ(together[i], alone[i]) << i;
        }
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (alone[i].empty()) continue;
        EXPECT_EQ(alone[i].find(i % 2 ? "PNG's" : "JPEG's"), alone[i].npos) << alone[i];
        EXPECT_EQ(alone[i].substr(0, 4), "the ") << alone[i];
    }
    const std::set<std::string> kinds(alone.begin(), alone.end());
    EXPECT_TRUE(kinds.contains("the PNG's compressed data is damaged"));
    EXPECT_TRUE(kinds.contains("the JPEG's compressed data is damaged"));
    EXPECT_GT(kinds.size(), 8u);
}

}  // namespace
}  // namespace si::test::image_decode
