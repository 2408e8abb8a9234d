// Tests of the frontier of cost and error, and of its statistics.
#include "renderer/measure/frontier.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace si {
namespace {

TEST(Spread, MatchesKnownSamples) {
    const Spread s = spread_of({5, 1, 3, 2, 4});
    EXPECT_DOUBLE_EQ(s.median, 3);
    EXPECT_DOUBLE_EQ(s.low, 1);
    EXPECT_DOUBLE_EQ(s.high, 5);
    EXPECT_NEAR(s.p95, 4.8, 1e-12);
    EXPECT_NEAR(s.relative(), 0.5 * (5 - 1) / 3, 1e-12) << "of five samples the interval is all of them";
    std::vector<double> many;
    for (int i = 0; i < 100; ++i) many.push_back(i);
    const Spread wide = spread_of(many);
    EXPECT_EQ(wide.median_low, 40);  // ranks 50 -+ 9.8
    EXPECT_EQ(wide.median_high, 59);
    // Six bursts or more: ranks of their medians, which one slow burst does not widen.
    std::vector<double> in_bursts;
    std::vector<std::size_t> firsts;
    for (const double ms : {3.0, 8.0, 1.0, 6.0, 4.0, 100.0, 2.0, 5.0}) {
        firsts.push_back(in_bursts.size());
        for (const double off : {0.0, -0.5, 0.5}) in_bursts.push_back(ms + off);
    }
    const Spread ranked = spread_of(in_bursts, firsts);
    EXPECT_EQ(ranked.bursts, 8);
    EXPECT_EQ(ranked.median_low, 2) << "rank 8 / 2 - 0.98 sqrt(8), from 0";
    EXPECT_EQ(ranked.median_high, 8);
    firsts.resize(5);
    const Spread by_mean = spread_of({in_bursts.begin(), in_bursts.begin() + 15}, firsts);
    EXPECT_NEAR(by_mean.noise(), 2.776 * std::sqrt(7.3 / 5), 1e-9) << "Student's t of 3, 8, 1, 6 and 4";
    EXPECT_EQ(spread_of({7}).relative(), 1) << "one sample says nothing of its spread";
    EXPECT_EQ(spread_of({}).samples, 0);
}

TEST(Frontier, KeepsUndominatedPoints) {
    const std::vector<Dot> dots = {{1, 10}, {2, 5}, {3, 6}, {4, 1}, {4, 2}};
    EXPECT_EQ(frontier(dots), (std::vector<bool>{true, true, false, true, false}));
}

TEST(Frontier, NoiseDecidesNoRank) {
    const std::vector<Dot> dots = {{1.00, 5, 0.05, 0.1}, {1.02, 5.05, 0.05, 0.1}, {1.02, 5.2, 0.05, 0.1}};
    EXPECT_EQ(frontier(dots), (std::vector<bool>{true, true, false}));
}

/// Uncertain values dominate nothing: here the second may take from 15 to 25.
TEST(Frontier, UncertainCostBeatsNoCheaperPoint) {
    const std::vector<Dot> dots = {{15, 5, 0.1}, {20, 2, 5}, {20.4, 3, 0.5}};
    EXPECT_EQ(frontier(dots), (std::vector<bool>{true, true, false}));
    EXPECT_EQ(frontier(std::vector<Dot>{{5, 15, 0, 0.1}, {2, 20, 0, 5}}), (std::vector<bool>{true, true}));
}

TEST(Frontier, FailedCasesAreNeverOnIt) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Dot> dots = {{nan, 0}, {1, 1}, {0, nan}};
    EXPECT_EQ(frontier(dots), (std::vector<bool>{false, true, false}));
}

TEST(Frontier, AdviceNamesTheNextBetterAndTheCheaper) {
    const std::vector<Dot> dots = {{1, 10}, {2, 5}, {4, 1}, {9, 0.5}};
    const auto on = frontier(dots);
    const FrontierAdvice advice = frontier_advice({3, 5}, dots, on);
    ASSERT_TRUE(advice.better && advice.cheaper);
    EXPECT_EQ(*advice.better, 2u);
    EXPECT_DOUBLE_EQ(advice.extra_cost, 1);
    EXPECT_EQ(*advice.cheaper, 1u);
    EXPECT_DOUBLE_EQ(advice.saved_cost, 1);
    const FrontierAdvice best = frontier_advice({9, 0.5}, dots, on);
    EXPECT_FALSE(best.better || best.cheaper);
}

}  // namespace
}  // namespace si
