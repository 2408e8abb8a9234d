// Tests of LDR-FLIP against values of other programs, and of its properties.
#include "renderer/reference/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shaders/shared/colours.h"
#include "tests/support/flip_pairs.h"
#include "tests/support/missing_reason.h"

namespace si {
namespace {

ByteImage uniform_picture(int width, int height, std::array<std::uint8_t, 3> rgb) {
    ByteImage out{width, height, {}};
    for (int i = 0; i < width * height; ++i) out.data.insert(out.data.end(), {rgb[0], rgb[1], rgb[2], 255});
    return out;
}

/// Turns a picture by half a circle.
ByteImage turned(const ByteImage& picture) {
    ByteImage out = picture;
    const std::size_t pixels = picture.data.size() / 4;
    for (std::size_t i = 0; i < pixels; ++i) std::copy_n(&picture.data[4 * i], 4, &out.data[4 * (pixels - 1 - i)]);
    return out;
}

TEST(Flip, AgreesWithSumsOverWholeFilters) {
    const std::vector<test::FlipPair> pairs = test::committed_flip_pairs();
    ASSERT_EQ(pairs.size(), 8u);
    for (const test::FlipPair& pair : pairs) {
        const Flip flip = flip_difference(test::picture_in(pair.a), test::picture_in(pair.b), pair.pixels_per_degree);
        EXPECT_NEAR(flip.mean, pair.mean, 2e-6) << pair.a << " at " << pair.pixels_per_degree;
        EXPECT_NEAR(flip.max, pair.max, 5e-6) << pair.a << " at " << pair.pixels_per_degree;
    }
}

TEST(Flip, AgreesWithTheAuthorsProgram) {
    const std::vector<test::FlipPair> pairs = test::shared_flip_pairs();
    if (pairs.empty()) GTEST_SKIP() << test::kMissingReason << "../shared/flip";
    for (const test::FlipPair& pair : pairs) {
        const Flip flip = flip_difference(test::picture_in(pair.a), test::picture_in(pair.b), pair.pixels_per_degree);
        EXPECT_NEAR(flip.mean, pair.mean, 5e-4) << pair.a << ' ' << pair.b;
        EXPECT_NEAR(flip.max, pair.max, 2e-3) << pair.a << ' ' << pair.b;
    }
}

TEST(Flip, EqualPicturesDifferNowhere) {
    const ByteImage picture = test::picture_in(test::committed_flip_pairs().front().a);
    ByteImage clear = picture;
    for (std::size_t i = 3; i < clear.data.size(); i += 4) clear.data[i] = 7;
    for (const ByteImage& other : {picture, clear}) {
        const Flip flip = flip_difference(picture, other);
        EXPECT_EQ(flip.mean, 0);
        EXPECT_EQ(flip.max, 0);
        EXPECT_TRUE(std::ranges::all_of(flip.map.data, [](float v) { return v == 0; })) << "alpha is no colour";
    }
}

TEST(Flip, LargestDifferencesAreThoseOfThePaper) {
    const auto of = [](std::array<std::uint8_t, 3> a, std::array<std::uint8_t, 3> b) {
        return flip_difference(uniform_picture(40, 30, a), uniform_picture(40, 30, b));
    };
    const Flip widest = of({0, 255, 0}, {0, 0, 255});
    EXPECT_NEAR(widest.mean, 1, 1e-6) << "green to blue is the largest distance of the gamut";
    EXPECT_NEAR(widest.max, 1, 1e-6);
    // Black and white differ by 100 in lightness alone. Green and blue differ by 55.4 in lightness and 147.9 in chroma.
    const Flip black_white = of({0, 0, 0}, {255, 255, 255});
    const double largest = std::pow(55.4 + 147.9, 0.7), power = std::pow(100.0, 0.7);
    EXPECT_NEAR(black_white.mean, 0.95 + 0.05 * (power - 0.4 * largest) / (0.6 * largest), 1e-4);
    EXPECT_NEAR(black_white.mean, black_white.max, 1e-6);
}

TEST(Flip, IsSymmetricAndTurnsWithThePictures) {
    for (const test::FlipPair& pair : test::committed_flip_pairs()) {
        const ByteImage a = test::picture_in(pair.a), b = test::picture_in(pair.b);
        const Flip flip = flip_difference(a, b), swapped = flip_difference(b, a),
                   round = flip_difference(turned(a), turned(b));
        EXPECT_EQ(flip.map.data, swapped.map.data) << pair.a;
        EXPECT_EQ(flip.mean, swapped.mean) << pair.a;
        ASSERT_EQ(round.map.data.size(), flip.map.data.size());
        float off = 0;
        for (std::size_t i = 0; i < flip.map.data.size(); ++i)
            off = std::max(off, std::abs(flip.map.data[i] - round.map.data[round.map.data.size() - 1 - i]));
        EXPECT_LT(off, 1e-5f) << pair.a;
    }
}

TEST(Flip, MeanAndMaximumAreThoseOfTheMap) {
    const test::FlipPair pair = test::committed_flip_pairs().front();
    const Flip flip = flip_difference(test::picture_in(pair.a), test::picture_in(pair.b));
    double sum = 0;
    for (const float v : flip.map.data) sum += v;
    EXPECT_NEAR(flip.mean, sum / double(flip.map.data.size()), 1e-7);
    EXPECT_FLOAT_EQ(float(flip.max), *std::ranges::max_element(flip.map.data));
}

TEST(Flip, RefusesPicturesOfDifferentSizesAndStopsOnRequest) {
    const ByteImage a = uniform_picture(8, 6, {1, 2, 3}), b = uniform_picture(8, 5, {1, 2, 3});
    EXPECT_THROW(flip_difference(a, b), Error);
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(flip_difference(a, a, kFlipPixelsPerDegree, {.stop = stop.get_token()}), Cancelled);
}

TEST(Flip, HeatMapRunsFromDarkBlueToYellow) {
    const ByteImage picture = flip_picture({4, 1, 1, {0, 0.5f, 1, 0.25f}});
    const auto channel = [](float v) { return std::uint8_t(std::lround(255 * v)); };
    const glm::vec3 stops[] = {shared::SEQUENTIAL_LOW, shared::SEQUENTIAL_MIDDLE, shared::SEQUENTIAL_HIGH,
                               glm::mix(shared::SEQUENTIAL_LOW, shared::SEQUENTIAL_MIDDLE, 0.5f)};
    for (std::size_t i = 0; i < 4; ++i)
        for (int c = 0; c < 3; ++c) EXPECT_EQ(picture.data[4 * i + std::size_t(c)], channel(stops[i][c])) << i;
}

}  // namespace
}  // namespace si
