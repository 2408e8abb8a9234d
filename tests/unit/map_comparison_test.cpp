// Tests the comparison of two map images against counts and quantiles that are computed a second time.
#include "renderer/inspect/map_comparison.h"

#include <gtest/gtest.h>

#include <random>

#include "renderer/base/error.h"

namespace si {
namespace {

/// Returns a view straight down from 20 m, over a square of 8 m.
LightView parallel_view(bool reversed = false) {
    LightView view;
    view.eye = {0, 20, 0};
    view.axes = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    view.curve = {.perspective = false, .near = 10, .far = 30, .convention = {.reversed = reversed}, .warp = {}};
    view.set_half_extents(glm::dvec2(4));
    return view;
}

FloatImage image_of(int width, int height, float depth) {
    return {width, height, 1, std::vector<float>(std::size_t(width) * std::size_t(height), depth)};
}

void set_texel(FloatImage& image, int x, int y, float depth) {
    image.data[std::size_t(y) * std::size_t(image.width) + std::size_t(x)] = depth;
}

TEST(MapComparisonTest, CountsMissedAndExtraTexels) {
    FloatImage theirs = image_of(40, 40, 1), ours = theirs;
    for (int y = 10; y < 30; ++y)
        for (int x = 10; x < 30; ++x) {
            set_texel(theirs, x, y, 0.5f);
            set_texel(ours, x, y, 0.5f);
        }
    for (int i = 0; i < 3; ++i) set_texel(theirs, 2 + i, 3, 0.25f);
    for (int i = 0; i < 5; ++i) set_texel(ours, 30, 12 + i, 0.75f);
    set_texel(ours, 36, 36, 0.75f);
    const MapComparison found = compare_maps(theirs, ours, parallel_view(), MapFormat::D16);
    EXPECT_EQ(found.covered, 403u);
    EXPECT_EQ(found.drawn, 406u);
    EXPECT_EQ(found.both, 400u);
    EXPECT_EQ(found.missed, 3u);
    EXPECT_EQ(found.extra, 6u);
    EXPECT_EQ(found.unexplained.from, glm::ivec2(2, 3));
    EXPECT_EQ(found.unexplained.to, glm::ivec2(5, 4));
    EXPECT_EQ(found.lacking.from, glm::ivec2(30, 12));
    EXPECT_EQ(found.lacking.to, glm::ivec2(37, 37));
    EXPECT_DOUBLE_EQ(found.missed_share(), 3.0 / 403);
    EXPECT_FALSE(found.gate.missed);
    EXPECT_FALSE(found.gate.extra);
    EXPECT_TRUE(found.gate.median && found.gate.most);
    EXPECT_NE(found.gate.text.find("0.74 % of its texels are missed, more than 0.1 %"), std::string::npos)
        << found.gate.text;
    EXPECT_NE(found.gate.text.find("6 texels are extra"), std::string::npos) << found.gate.text;
    const MapComparison border = compare_maps(theirs, ours, parallel_view(), MapFormat::D16, {}, {.border_texels = 1});
    EXPECT_EQ(border.extra, 1u);
    EXPECT_EQ(border.extra_border, 5u);
}

TEST(MapComparisonTest, LeavesOutMaskedTexelsOfBoth) {
    FloatImage theirs = image_of(20, 20, 0.5f), ours = theirs;
    std::vector<bool> masked(400);
    for (int x = 0; x < 20; ++x) {
        set_texel(theirs, x, 4, 1);
        set_texel(ours, x, 7, 1);
        masked[std::size_t(4 * 20 + x)] = masked[std::size_t(7 * 20 + x)] = true;
    }
    const MapComparison found = compare_maps(theirs, ours, parallel_view(), MapFormat::D16, masked);
    EXPECT_EQ(found.masked, 40u);
    EXPECT_EQ(found.covered, 360u);
    EXPECT_EQ(found.missed + found.extra, 0u);
    EXPECT_TRUE(found.gate.passed()) << found.gate.text;
    EXPECT_FALSE(compare_maps(theirs, ours, parallel_view(), MapFormat::D16).gate.passed());
}

// Depths that are no numbers hold no caster. Exponential maps of some engines have them.
TEST(MapComparisonTest, InvalidDepthsAreEmpty) {
    FloatImage theirs = image_of(8, 8, 0.5f);
    const FloatImage ours = theirs;
    set_texel(theirs, 1, 1, std::numeric_limits<float>::quiet_NaN());
    set_texel(theirs, 2, 1, 1.5f);
    set_texel(theirs, 3, 1, -0.5f);
    const MapComparison found = compare_maps(theirs, ours, parallel_view(), MapFormat::D16);
    EXPECT_EQ(found.invalid, 3u);
    EXPECT_EQ(found.covered, 61u);
    EXPECT_EQ(found.extra, 3u);
}

// A parallel view of 20 m has 20 m of depth from 0 to 1, and a texel of 0.2 m.
TEST(MapComparisonTest, DifferencesHaveTheQuantilesOfASortedList) {
    std::mt19937 random(7);
    std::normal_distribution<double> steps(3, 5);
    for (const bool reversed : {false, true}) {
        FloatImage theirs = image_of(40, 40, 0.5f), ours = theirs;
        std::vector<double> depths;
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x) {
                const float depth = float(0.5 + std::round(steps(random)) / 65535);
                set_texel(theirs, x, y, depth);
                depths.push_back((reversed ? -1 : 1) * (double(depth) - 0.5));
            }
        const MapComparison found = compare_maps(theirs, ours, parallel_view(reversed), MapFormat::D16);
        std::vector<double> sizes;
        for (const double d : depths) sizes.push_back(std::abs(d));
        std::ranges::sort(depths);
        std::ranges::sort(sizes);
        const auto quantile = [](const std::vector<double>& v, double share) {
            return v[std::size_t(std::lround(share * double(v.size() - 1)))];
        };
        EXPECT_DOUBLE_EQ(found.depth.signed_median, quantile(depths, 0.5));
        EXPECT_DOUBLE_EQ(found.depth.median, quantile(sizes, 0.5));
        EXPECT_DOUBLE_EQ(found.depth.most_of_99, quantile(sizes, 0.99));
        EXPECT_DOUBLE_EQ(found.depth.max, sizes.back());
        EXPECT_NEAR(found.steps.max, sizes.back() * 65535, 1e-6);
        EXPECT_NEAR(found.metres.most_of_99, quantile(sizes, 0.99) * 20, 1e-9);
        EXPECT_NEAR(found.texels.median, quantile(sizes, 0.5) * 20 / 0.2, 1e-9);
        EXPECT_EQ(found.metres.signed_median > 0, !reversed);
        EXPECT_FALSE(found.gate.median || found.gate.most);
    }
}

TEST(MapComparisonTest, TheGateCountsStepsOfTheFormat) {
    const FloatImage ours = image_of(10, 10, 0.5f);
    const auto gate = [&](MapFormat format, double difference) {
        return compare_maps(image_of(10, 10, float(0.5 + difference)), ours, parallel_view(), format).gate;
    };
    EXPECT_TRUE(gate(MapFormat::D16, 0.9 / 65535).passed());
    EXPECT_FALSE(gate(MapFormat::D16, 1.5 / 65535).median);
    EXPECT_TRUE(gate(MapFormat::D16, 1.5 / 65535).most);
    EXPECT_FALSE(gate(MapFormat::D16, 5.0 / 65535).most);
    EXPECT_TRUE(gate(MapFormat::D32F, 0x1p-24).passed());
    EXPECT_FALSE(gate(MapFormat::D32F, 0.9 / 65535).passed());
    // Floats near 0 have finer steps than the clip-space z that they are made of.
    const FloatImage near_zero = image_of(10, 10, 1e-4f), beside = image_of(10, 10, 1e-4f + 4e-8f);
    EXPECT_TRUE(compare_maps(beside, near_zero, parallel_view(true), MapFormat::D32F).gate.passed());
    EXPECT_FALSE(compare_maps(image_of(10, 10, 1), image_of(10, 10, 0.5f), parallel_view(), MapFormat::D16).gate.most)
        << "nothing was compared";
    EXPECT_TRUE(compare_maps(image_of(10, 10, 1), image_of(10, 10, 1), parallel_view(), MapFormat::D16).gate.passed())
        << "both maps are empty";
    EXPECT_THROW(compare_maps(image_of(10, 9, 1), ours, parallel_view(), MapFormat::D16), Error);
}

TEST(MapComparisonTest, FindsTheConventionThatWouldFit) {
    FloatImage ours = image_of(32, 32, 1);
    for (int y = 2; y < 12; ++y)
        for (int x = 3; x < 27 - y; ++x) set_texel(ours, x, y, 0.2f + 0.01f * float(x));
    const auto hint = [&](const auto& read) {
        FloatImage theirs = ours;
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x) set_texel(theirs, x, y, read(x, y));
        return compare_maps(theirs, ours, parallel_view(), MapFormat::D16).gate.hint;
    };
    EXPECT_EQ(hint([&](int x, int y) { return ours.at(x, y); }), "");
    EXPECT_NE(hint([&](int x, int y) { return ours.at(x, 31 - y); }).find("first_row"), std::string::npos);
    EXPECT_NE(hint([&](int x, int y) { return ours.at(31 - x, y); }).find("columns"), std::string::npos);
    EXPECT_NE(hint([&](int x, int y) { return 1 - ours.at(x, y); }).find("depth.reversed"), std::string::npos);
    EXPECT_EQ(hint([&](int x, int y) { return 0.5f + 0.001f * float(x * y % 7); }), "");
}

TEST(MapComparisonTest, ColoursTellNearerFromFarther) {
    using Rgb = std::array<std::uint8_t, 3>;
    EXPECT_EQ(difference_colour(0, 1), (Rgb{240, 240, 240}));
    EXPECT_EQ(difference_colour(-5, 1), difference_colour(-1, 1));
    EXPECT_GT(difference_colour(-1, 1)[2], difference_colour(-1, 1)[0]);
    EXPECT_GT(difference_colour(1, 1)[0], difference_colour(1, 1)[2]);
    FloatImage theirs = image_of(3, 2, 0.5f);
    const FloatImage ours = image_of(3, 2, 0.5f);
    set_texel(theirs, 1, 0, 1);
    set_texel(theirs, 2, 1, 0.6f);
    const MapComparison found = compare_maps(theirs, ours, parallel_view(), MapFormat::D16);
    EXPECT_NEAR(difference_scale_m(found), 2, 1e-6) << "a tenth of 20 m";
    const ByteImage picture = difference_picture(found, 2);
    const auto pixel = [&](int x, int y) {
        const auto* p = &picture.data[std::size_t(4 * (3 * y + x))];
        return Rgb{p[0], p[1], p[2]};
    };
    EXPECT_EQ(pixel(0, 0), difference_colour(0, 2));
    EXPECT_EQ(pixel(1, 0), MapDifferenceColours().extra);
    EXPECT_EQ(pixel(2, 1), difference_colour(2, 2));
}

}  // namespace
}  // namespace si
