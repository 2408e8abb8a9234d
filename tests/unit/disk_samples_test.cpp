// Tests of sample positions on a disk.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/base/poisson_disk.h"

namespace si {
namespace {

TEST(DiskSamplesTest, SpiralTurnsByTheGoldenAngleAndCoversEqualAreas) {
    for (const int n : {1, 16, 4096}) {
        const std::vector<glm::vec2> places = spiral_places(n);
        ASSERT_EQ(int(places.size()), n);
        for (int i = 0; i < n; ++i) {
            const double angle = std::fmod(i * (3 - std::sqrt(5.0)) * std::numbers::pi, 2 * std::numbers::pi);
            const double radius = std::sqrt((i + 0.5) / n);
            // 2^32 parts of a turn, with accumulated rounding.
            EXPECT_NEAR(places[std::size_t(i)].x, radius * std::cos(-angle), 1e-5) << i << " of " << n;
            EXPECT_NEAR(places[std::size_t(i)].y, radius * std::sin(-angle), 1e-5) << i << " of " << n;
        }
    }
}

TEST(DiskSamplesTest, TableEndsAndItsFirstSamplesAreApart) {
    EXPECT_EQ(poisson_places(1000).size(), std::size_t(kDiskTable));
    const std::vector<glm::vec2> places = poisson_places(16);
    ASSERT_EQ(places.size(), 16u);
    for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_LE(glm::length(places[i]), 1.f);
        for (std::size_t k = 0; k < i; ++k) EXPECT_GT(glm::distance(places[i], places[k]), 0.25f) << i << ", " << k;
    }
}

}  // namespace
}  // namespace si
