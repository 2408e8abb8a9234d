// Tests of measured savings: paired differences of alternating frames, by a made-up clock.
#include <gtest/gtest.h>

#include "renderer/measure/optimisation_times.h"

namespace si {
namespace {

constexpr Optimisation kOptimisation = Optimisation::DeadPasses;
const std::vector<Optimisation> kOne = {kOptimisation};

TEST(MeasuredSaving, IsTheDifferenceUnderChangingLoad) {
    double drift = 0;  // drift of a machine that slows down, three times the saving in each frame
    const auto saved = time_optimisations_alternating(kOne, 16, [&](OptimisationSet forced) {
        drift += 3;
        return 100 + drift + (forced.contains(kOptimisation) ? 5 : 0);
    });
    ASSERT_EQ(saved.size(), 1u);
    EXPECT_NEAR(saved[0].ms.median, 5, 1e-9);
    EXPECT_NEAR(saved[0].ms.low, 2, 1e-9) << "each of the two is drawn first in every other round";
    EXPECT_NEAR(saved[0].ms.high, 8, 1e-9);
    EXPECT_EQ(saved[0].ms.samples, 16);
}

TEST(MeasuredSaving, ShowsTheTimesSoFar) {
    std::vector<int> samples;
    std::vector<SavedTime> last;
    const auto draw = [](OptimisationSet forced) { return forced.contains(kOptimisation) ? 7.0 : 4.0; };
    const auto saved = time_optimisations_alternating(kOne, 5, draw, {}, [&](const std::vector<SavedTime>& so_far) {
        samples.push_back(so_far.at(0).ms.samples);
        last = so_far;
    });
    EXPECT_EQ(samples, (std::vector{2, 3, 4, 5})) << "one difference alone has no interval";
    EXPECT_EQ(last.at(0).ms.median, saved.at(0).ms.median);
}

TEST(MeasuredSaving, MayBeNegativeAndItsIntervalHoldsTheMedian) {
    int frame = 0;
    const auto saved = time_optimisations_alternating(kOne, 20, [&](OptimisationSet forced) {
        return 10 + 0.1 * (++frame % 7) - (forced.contains(kOptimisation) ? 4.0 : 0.0);
    });
    const Spread& ms = saved[0].ms;
    EXPECT_NEAR(ms.median, -4, 0.7);
    EXPECT_LT(ms.median_low, ms.median_high);
    EXPECT_LE(ms.median_low, ms.median);
    EXPECT_GE(ms.median_high, ms.median);
    EXPECT_LT(ms.median_high, 0) << "the interval is not cut off at nothing";
}

TEST(MeasuredSaving, DrawsTheAnnouncedFramesAndReportsProgress) {
    int plain = 0, forced = 0;
    double share = 0;
    time_optimisations_alternating(
        kOne, 7,
        [&](OptimisationSet f) {
            ++(f.empty() ? plain : forced);
            return 1.0;
        },
        [&](double s) {
            EXPECT_GE(s, share);
            share = s;
        });
    EXPECT_EQ(plain, 7);
    EXPECT_EQ(forced, 7);
    EXPECT_EQ(share, 1);
}

TEST(MeasuredSaving, OfAnEffectCountsItsOptimisationOrItsCachedPass) {
    SavedTimes times;
    times.optimisations.push_back({kOptimisation, {.median = 2}});
    PassTime pass;
    pass.name = "shadow map 0 (spot)";
    pass.gpu_ms.median = 7;
    times.frame.passes.push_back(pass);
    Effect effect{.name = "map", .state = EffectState::Cached, .pass = pass.name};
    ASSERT_TRUE(times.saved_ms(effect));
    EXPECT_EQ(times.saved_ms(effect)->median, 7);
    effect.part = true;
    EXPECT_FALSE(times.saved_ms(effect)) << "the pass's time is not this one's alone";
    effect.optimisation = kOptimisation;
    ASSERT_TRUE(times.saved_ms(effect));
    EXPECT_EQ(times.saved_ms(effect)->median, 2);
    effect = {.name = "blur", .state = EffectState::NotNeeded, .pass = pass.name};
    EXPECT_FALSE(times.saved_ms(effect)) << "nothing spares it";
    EXPECT_EQ(optimisations_of(std::vector<Effect>{effect}).size(), 0u);
    effect.optimisation = kOptimisation;
    EXPECT_EQ(optimisations_of(std::vector<Effect>{effect, effect}).size(), 1u);
}

}  // namespace
}  // namespace si
