// Opens what shadow_bundle.h writes by the program's own reader of bundles.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "assets/bundle/shadow_bundle.h"
#include "renderer/bundle/bundle_files.h"
#include "renderer/bundle/bundle_json.h"
#include "renderer/bundle/map_image.h"
#include "tests/unit/gltf_test_file.h"

namespace si {
namespace {

namespace fs = std::filesystem;

std::string text_of(BundleFiles& files, std::string_view name) {
    const std::vector<std::byte> bytes = files.read(name, kMaxFrameJsonBytes);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(BundleWriters, TheReaderFindsAllThatTheHeaderWrites) {
    const test::TemporaryFolder folder;
    const fs::path path = folder.path() / "frame.bundle";
    shadow_bundle* const sb = sb_begin(path.c_str(), "an engine");
    const std::array<double, 3> origin = {10, 0, -20.5};
    sb_world(sb, SB_DOWN_X, SB_LEFT_HANDED, 0.01, origin.data());
    sb_matrix clip{};
    for (int i = 0; i < 16; ++i) clip.m[i] = i % 5 == 0 ? 0.1 * (i + 1) : 0;
    sb_camera(sb, clip, 64, 32, SB_RANGE_0_TO_1, 1);
    const std::array<std::uint8_t, 4> pixel = {1, 2, 3, 255};
    sb_picture(sb, pixel.data(), 1, 1, 0, SB_FIRST_ROW_TOP);
    sb_note(sb, "A remark.");
    const int sun = sb_light(sb, "sun", SB_DIRECTIONAL);
    sb_light_direction(sb, sun, 1, -2, 3);
    sb_light_choice(sb, sun, SB_CHOICE_INTERVAL);
    sb_lookup_bias(sb, sun, SB_BIAS_NORMAL, 0.5, SB_UNIT_TEXELS);
    sb_lookup_normal_by(sb, sun, SB_NORMAL_BY_ONE_MINUS_COSINE);
    sb_lookup_kernel(sb, sun, "pcf3");
    sb_lookup_compare(sb, sun, SB_GREATER_EQUAL);
    sb_lookup_sampler(sb, sun, SB_LINEAR, SB_BORDER);
    sb_lookup_shader(sb, sun, "text");
    const std::array<std::uint16_t, 8> shorts = {0, 65535, 1, 2, 3, 4, 5, 6};
    const std::array<std::uint32_t, 8> words = {0, 0xffffff, 1, 2, 3, 4, 5, 6};
    const std::array<float, 8> floats = {0, 1, 0.5f, 0.25f, 0.1f, 0.2f, 0.3f, 0.4f};
    const std::array<std::uint16_t, 8> halves = {0, 0x3c00, 0x3800, 0x3400, 0, 0, 0, 0};
    struct Texels {
        const void* data;
        sb_texel type;
        int channels;
    };
    for (const Texels& texels :
         {Texels{shorts.data(), SB_U16, 1}, Texels{words.data(), SB_U24, 1}, Texels{words.data(), SB_U32, 1},
          Texels{floats.data(), SB_F32, 1}, Texels{floats.data(), SB_F32, 2}, Texels{halves.data(), SB_F16, 2}}) {
        sb_image_data image{};
        image.texels = texels.data;
        image.type = texels.type;
        image.width = 2;
        image.height = 2;
        image.channels = texels.channels;
        image.channel = texels.channels - 1;
        image.first_row = SB_FIRST_ROW_TOP;
        const int map = sb_map(sb, sun, sb_image(sb, &image), clip, SB_RANGE_0_TO_1, 1);
        sb_map_region(sb, map, 1, 0, 1, 2);
        sb_map_clear(sb, map, 0);
        sb_map_offset(sb, map, -1, -2, 0);
        sb_map_cull(sb, map, SB_CULL_FRONT, SB_FRONT_CW);
        sb_map_depth_clamp(sb, map, 0);
        sb_map_interval(sb, map, 1, 2);
        sb_map_drawn(sb, map, nullptr, 0);
    }
    std::array<char, 512> message{};
    ASSERT_EQ(sb_end(sb, message.data(), message.size()), SB_OK) << message.data();

    BundleFiles files(path);
    const Bundle bundle = parse_bundle(text_of(files, kFrameJson), "frame.json");
    EXPECT_EQ(bundle.made_by, "an engine");
    EXPECT_EQ(bundle.world, (BundleWorld{UpAxis::MinusX, true, 0.01, {10, 0, -20.5}}));
    ASSERT_TRUE(bundle.camera);
    EXPECT_EQ(bundle.camera->width, 64);
    EXPECT_TRUE(bundle.camera->depth.reversed);
    EXPECT_EQ(bundle.camera->clip.matrix()[3][3], clip.m[15]);
    EXPECT_TRUE(files.has(bundle.picture));
    EXPECT_EQ(bundle.notes, std::vector<std::string>{"A remark."});
    ASSERT_EQ(bundle.lights.size(), 1u);
    const BundleLight& light = bundle.lights[0];
    EXPECT_EQ(light.direction, glm::dvec3(1, -2, 3));
    EXPECT_EQ(choice_of(light), ViewChoice::Interval);
    EXPECT_FALSE(light.lookup.bias.constant);
    EXPECT_EQ(light.lookup.bias.normal, 0.5);
    EXPECT_EQ(light.lookup.bias.units[2], BiasUnit::Texels);
    EXPECT_EQ(light.lookup.bias.normal_by, OffsetBy::OneMinusCosine);
    EXPECT_EQ(light.lookup.compare, BundleCompare::GreaterEqual);
    EXPECT_EQ(light.lookup.wrap, BundleWrap::Border);
    EXPECT_EQ(text_of(files, light.lookup.shader), "text");
    ASSERT_EQ(light.maps.size(), 6u);
    const std::array<float, 6> second = {1, 1, float(0xffffff / 4294967295.0), 1, 0.25f, 0.25f};
    for (std::size_t i = 0; i < light.maps.size(); ++i) {
        SCOPED_TRACE(i);
        const BundleMap& map = light.maps[i];
        EXPECT_EQ(map.region, (BundleRegion{1, 0, 1, 2}));
        EXPECT_EQ(map.depth.clear, 0);
        EXPECT_EQ(map.raster.offset_units, -2);
        EXPECT_EQ(map.raster.cull, Cull::Front);
        EXPECT_EQ(map.raster.front, BundleFront::Cw);
        EXPECT_EQ(map.raster.depth_clamp, false);
        EXPECT_EQ(map.interval, (std::array<double, 2>{1, 2}));
        EXPECT_EQ(map.drawn, std::vector<std::string>());
        EXPECT_EQ(first_row_of(map.image), FirstRow::Top);
        const std::vector<std::byte> bytes = files.read(map.image.file, 1000);
        const FloatImage image = decode_map_image(
            map.image.file, bytes, {map.image.width, map.image.height, map.image.channels, map.image.format});
        EXPECT_EQ(image.width, 2);
        EXPECT_FLOAT_EQ(image.at(1, 0, map.image.channel), second[i]);
    }
}

}  // namespace
}  // namespace si
