#include "renderer/inspect/kernel_taps.h"

#include <gtest/gtest.h>

#include <random>

namespace si {
namespace {

TEST(KernelTaps, WeightsSumToOneAndReachNoFartherThanTheRowSays) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-2, 40);
    for (const Filter& filter : filters())
        for (int i = 0; i < 50; ++i) {
            const glm::dvec2 centre(place(random), place(random));
            const auto taps = kernel_texels(filter, centre);
            ASSERT_EQ(taps.size(), std::size_t(footprint_width(filter) * footprint_width(filter)));
            double sum = 0, farthest = 0;
            glm::dvec2 mean(0);
            for (const KernelTexel& t : taps) {
                sum += t.weight;
                mean += t.weight * (glm::dvec2(t.texel) + 0.5);
                const glm::dvec2 off = glm::abs(glm::dvec2(t.texel) + 0.5 - centre);
                farthest = std::max({farthest, off.x, off.y});
            }
            EXPECT_NEAR(sum, 1, 1e-12) << filter.key;
            EXPECT_LE(farthest, filter.reach_texels + 1e-9) << filter.key;
            EXPECT_GT(farthest, filter.reach_texels - 1) << filter.key;
            // Bilinear weights are centred exactly; nearest ones on a texel's centre.
            EXPECT_LE(glm::length(mean - centre), filter.bilinear ? 1e-9 : 0.7072) << filter.key;
        }
}

TEST(KernelTaps, BilinearSharesOfOneTap) {
    const Filter& hw = filters()[1];
    ASSERT_EQ(hw.key, "hw2x2");
    const auto taps = kernel_texels(hw, {10.75, 20.6});  // texel centres at 10.5 and 11.5, 20.5 and 21.5
    EXPECT_EQ(taps[0].texel, glm::ivec2(10, 20));
    EXPECT_NEAR(taps[0].weight, 0.75 * 0.9, 1e-12);
    EXPECT_NEAR(taps[1].weight, 0.25 * 0.9, 1e-12);
    EXPECT_NEAR(taps[2].weight, 0.75 * 0.1, 1e-12);
    EXPECT_EQ(taps[3].texel, glm::ivec2(11, 21));
    EXPECT_NEAR(taps[3].weight, 0.25 * 0.1, 1e-12);
}

}  // namespace
}  // namespace si
