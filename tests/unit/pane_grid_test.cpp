// Tests of the split view's grid, and of colour scales fitted to values.
#include "renderer/frame/pane_grid.h"

#include <gtest/gtest.h>

#include <limits>

#include "renderer/frame/value_range.h"
#include "renderer/settings/settings.h"

namespace si {
namespace {

TEST(PaneGrid, PanesAndGapsFillThePicture) {
    const PaneGrid one = pane_grid(Panes::One, 640, 480, 3);
    EXPECT_EQ(one.count(), 1);
    EXPECT_EQ(glm::ivec2(one.width, one.height), glm::ivec2(640, 480));
    const PaneGrid two = pane_grid(Panes::Two, 641, 480, 3);
    EXPECT_EQ(two.count(), 2);
    EXPECT_EQ(glm::ivec2(two.width, two.height), glm::ivec2(319, 480));
    EXPECT_EQ(two.corner(1), glm::ivec2(322, 0));
    const PaneGrid four = pane_grid(Panes::Four, 643, 483, 3);
    EXPECT_EQ(four.count(), 4);
    EXPECT_EQ(glm::ivec2(four.width, four.height), glm::ivec2(320, 240));
    EXPECT_EQ(four.corner(3), glm::ivec2(323, 243));
    EXPECT_EQ(four.corner(2), glm::ivec2(0, 243));
}

TEST(PaneGrid, FindsThePaneUnderAPixel) {
    const PaneGrid grid = pane_grid(Panes::Four, 643, 483, 3);
    const auto place = grid.pane_at({330, 10});
    ASSERT_TRUE(place);
    EXPECT_EQ(place->pane, 1);
    EXPECT_EQ(place->pixel, glm::ivec2(7, 10));
    EXPECT_EQ(grid.pane_at({5, 480})->pane, 2);
    EXPECT_FALSE(grid.pane_at({321, 10})) << "a gap";
    EXPECT_FALSE(grid.pane_at({10, 241})) << "a gap";
    EXPECT_FALSE(grid.pane_at({-1, 10}));
    EXPECT_FALSE(grid.pane_at({643, 10}));
}

TEST(PaneGrid, APaneIsNeverEmpty) {
    const PaneGrid grid = pane_grid(Panes::Four, 1, 1, 3);
    EXPECT_EQ(glm::ivec2(grid.width, grid.height), glm::ivec2(1));
}

FloatImage values_of(const std::vector<float>& values) {
    FloatImage image{int(values.size()), 1, 4, {}};
    for (const float v : values) image.data.insert(image.data.end(), {v, 0, 0, 1});
    return image;
}

TEST(FittedRange, SpansThePercentilesWithoutOutliers) {
    std::vector<float> values;
    for (int i = 0; i <= 1000; ++i) values.push_back(float((i * 3) % 1001));
    values[3] = 1e9f;
    values[4] = -1e9f;
    const auto range = fitted_range(values_of(values), false);
    ASSERT_TRUE(range);
    EXPECT_NEAR(range->min, 10, 1);
    EXPECT_NEAR(range->max, 990, 1);
}

TEST(FittedRange, CountsOnlyDrawnAndFiniteValues) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    FloatImage image = values_of({nan, 2, inf, 4, -inf, 1000});
    image.data[4 * 5 + 3] = 0;  // background
    EXPECT_EQ(fitted_range(image, false), (ValueRange{2, 4}));
    EXPECT_FALSE(fitted_range(values_of({nan, inf}), false));
    EXPECT_FALSE(fitted_range(FloatImage{}, false));
}

TEST(FittedRange, StaysCentredOnZeroForDivergingScales) {
    EXPECT_EQ(fitted_range(values_of({-1, 0.5f, 3}), true), (ValueRange{-3, 3}));
    EXPECT_EQ(fitted_range(values_of({-5, -4}), true), (ValueRange{-5, 5}));
}

TEST(FittedRange, IsNeverEmpty) {
    for (const float v : {0.0f, 1.0f, -250.0f}) {
        const auto range = fitted_range(values_of({v, v, v}), false);
        ASSERT_TRUE(range);
        EXPECT_LT(range->min, v);
        EXPECT_GT(range->max, v);
        EXPECT_LE(range->max - range->min, std::max(2e-3f * std::abs(v), 2e-6f));
    }
}

}  // namespace
}  // namespace si
