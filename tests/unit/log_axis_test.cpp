// Tests of logarithmic axes of plots.
#include "ui/widgets/log_axis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace si {
namespace {

TEST(LogAxis, SpansItsValuesWithARoundTick) {
    for (const auto& values : {std::vector{0.031, 0.07}, {61.0, 62.0}, {3e-6, 4.0}, {1e3, 1e12}, {5.0}}) {
        const LogAxis axis = log_axis(values);
        EXPECT_LT(axis.low, values.front());
        EXPECT_GT(axis.high, values.back());
        double last = 0;
        int numbers = 0;
        for (const LogAxis::Tick& tick : axis.ticks) {
            EXPECT_GT(tick.value, last);
            EXPECT_GE(axis.position(tick.value), 0);
            EXPECT_LE(axis.position(tick.value), 1);
            last = tick.value;
            if (tick.text.empty()) continue;
            ++numbers;
            EXPECT_NEAR(std::stod(tick.text) / tick.value, 1, 1e-6);
        }
        EXPECT_GE(numbers, 1) << values.front();
        EXPECT_LE(numbers, 14) << values.front();
    }
}

TEST(LogAxis, EqualFactorsAreEqualLengths) {
    const LogAxis axis = log_axis(std::vector{1.0, 1000.0});
    EXPECT_NEAR(axis.position(10) - axis.position(1), axis.position(1000) - axis.position(100), 1e-12);
    EXPECT_GT(axis.position(10), axis.position(1));
}

TEST(LogAxis, ZeroHasItsOwnPosition) {
    const LogAxis without = log_axis(std::vector{1.0, 10.0}), with = log_axis(std::vector{0.0, 1.0, 10.0});
    EXPECT_FALSE(without.zero);
    ASSERT_TRUE(with.zero);
    EXPECT_EQ(with.position(0), 0);
    EXPECT_GE(with.position(with.low), LogAxis::kZeroShare);
    EXPECT_EQ(with.ticks.front().text, "0");
    EXPECT_TRUE(log_axis(std::vector{0.0}).zero);
}

TEST(LogAxis, BytesArePowersOfTwoWithUnits) {
    constexpr double kMiB = 1 << 20;
    for (const auto& values :
         {std::vector{2e6, 2.5e7}, {7.78e6, 7.9e6}, {1.0, 4e9}, {300.0 * 1024, 1.9 * kMiB}, {0.0, 2 * kMiB}}) {
        const LogAxis axis = log_axis(values, true);
        double last = -1;
        int numbers = 0;
        for (const LogAxis::Tick& tick : axis.ticks) {
            EXPECT_GT(tick.value, last);
            last = tick.value;
            if (tick.text.empty()) continue;
            ++numbers;
            EXPECT_EQ(tick.text.find('e'), std::string::npos) << tick.text;
            const double unit = tick.text.ends_with(" MiB") ? kMiB : tick.text.ends_with(" KiB") ? 1024 : 1;
            EXPECT_TRUE(tick.text.ends_with('B')) << tick.text;
            EXPECT_EQ(std::stod(tick.text) * unit, tick.value) << tick.text;
        }
        EXPECT_GE(numbers, 2) << values.front();
        EXPECT_LE(numbers, 14) << values.front();
    }
    const LogAxis axis = log_axis(std::vector{2e6, 2.5e7}, true);
    EXPECT_TRUE(std::ranges::any_of(axis.ticks, [](const LogAxis::Tick& t) { return t.text == "8 MiB"; }));
}

TEST(LogAxis, NonFiniteValuesDoNotCount) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    const LogAxis axis = log_axis(std::vector{2.0, nan, inf, 4.0}), plain = log_axis(std::vector{2.0, 4.0});
    EXPECT_EQ(axis.low, plain.low);
    EXPECT_EQ(axis.high, plain.high);
    EXPECT_FALSE(log_axis({}).ticks.empty());
}

}  // namespace
}  // namespace si
