#include "renderer/measure/time_sampler.h"

#include <gtest/gtest.h>

#include "renderer/techniques.h"

namespace si {
namespace {

FrameResult frame_of(double shadow_ms, double shade_ms, bool reused = false) {
    FrameResult f;
    f.clock = "a clock";
    f.passes = {{"shadow map 0", reused ? PassState::Reused : PassState::Ran, "", shadow_ms, 0.1, 3, 100},
                {"shading", PassState::Ran, "", shade_ms, 0.2, 5, 200},
                {"overlay", PassState::Skipped, "", 99, 99, 9, 900}};
    return f;
}

TEST(TimeSampler, TheFirstFrameWarmsUpAndSkippedPassesDoNotCount) {
    TimeSampler sampler;
    sampler.add(frame_of(1000, 1000));
    for (int i = 0; i < 5; ++i) sampler.add(frame_of(2, 3));
    const TimeMeasurement m = sampler.result();
    EXPECT_EQ(m.total_ms.samples, 5);
    EXPECT_DOUBLE_EQ(m.total_ms.median, 5);
    ASSERT_EQ(m.passes.size(), 2u);
    EXPECT_EQ(m.passes[1].name, "shading");
    EXPECT_DOUBLE_EQ(m.passes[1].gpu_ms.median, 3);
    EXPECT_EQ(m.clock, "a clock");
    EXPECT_DOUBLE_EQ(m.maps_ms.median, 2);
    EXPECT_DOUBLE_EQ(m.picture_ms.median, 3);
}

TEST(TimeSampler, SamplesOfSeveralTurnsAreOne) {
    TimeSamples all, turn;
    for (const double ms : {1.0, 2.0}) turn.add(frame_of(ms, 3));
    all.add(turn);
    turn = {};
    turn.add(frame_of(5, 3));
    all.add(turn);
    const TimeMeasurement m = summary(all);
    EXPECT_EQ(m.total_ms.samples, 3);
    EXPECT_DOUBLE_EQ(m.total_ms.median, 5);
    EXPECT_DOUBLE_EQ(m.maps_ms.high, 5);
    ASSERT_EQ(m.passes.size(), 2u);
    EXPECT_EQ(m.passes[0].gpu_ms.samples, 3);
    EXPECT_FALSE(m.settled);
}

TEST(TimeSampler, GoesOnUntilTheFigureStandsStill) {
    TimeSampler calm, wild({.least = 5, .most = 20, .spread = 0.03});
    calm.add(frame_of(0, 0)), wild.add(frame_of(0, 0));
    for (int i = 0; i < 4; ++i) calm.add(frame_of(2, 3));
    EXPECT_FALSE(calm.done()) << "fewer than the least number of frames";
    calm.add(frame_of(2, 3));
    EXPECT_TRUE(calm.done());
    EXPECT_TRUE(calm.result().settled);
    int frames = 0;
    while (!wild.done()) wild.add(frame_of(frames++ % 2 ? 10 : 1, 0));
    EXPECT_EQ(wild.frames(), 20);
    EXPECT_FALSE(wild.result().settled);
}

TEST(WorkCost, CountsTexelsTapsAndDraws) {
    Settings s;
    s.map.resolution = 512;
    FrameResult f = frame_of(1, 1);
    f.map_resolution = 512;
    f.colour = {.texture = 1, .width = 10, .height = 20};
    f.lights.resize(2);
    f.lights[0].casts = true;
    f.lights[0].views.resize(6);
    const WorkCost cost = work_cost(s, f);
    EXPECT_EQ(cost.map_texels, 6u * 512 * 512) << "the second light casts nothing";
    EXPECT_EQ(cost.map_bytes, 4 * cost.map_texels);
    EXPECT_EQ(cost.draws, 8u);
    EXPECT_EQ(cost.triangles, 300u);
    const Filter& kernel = filters()[std::size_t(s.filter.kernel)];
    EXPECT_EQ(cost.taps_per_pixel, 4.0 * kernel.gathers);
    EXPECT_EQ(cost.bytes_touched, cost.map_bytes + 10 * 20 * 4 * std::uint64_t(cost.taps_per_pixel));
    s.filter.method = int(FilterMethod::Sampler);
    s.map.format = int(MapFormat::D16);
    EXPECT_EQ(work_cost(s, f).map_bytes, 2 * cost.map_texels);
    // A bilinear tap of a sampler compares 2x2 texels; a nearest one a single texel, as do nearest kernels by gathers.
    for (std::size_t i = 0; i < filters().size(); ++i) {
        s.filter.kernel = int(i);
        const Filter& f2 = filters()[i];
        EXPECT_EQ(work_cost(s, f).taps_per_pixel, f2.size * f2.size * (f2.bilinear ? 4 : 1)) << f2.key;
    }
    s.filter.kernel = Settings{}.filter.kernel;
    s.map.format = int(MapFormat::Colour);  // which no sampler can compare
    EXPECT_EQ(work_cost(s, f).taps_per_pixel, 4.0 * kernel.gathers);
}

}  // namespace
}  // namespace si
