// Tests of time measurement over bursts of frames, and of counted work.
#include "renderer/measure/time_sampler.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/settings/depth_compare.h"
#include "renderer/settings/filters.h"

namespace si {
namespace {

FrameResult frame_of(double shadow_ms, double shade_ms, bool reused = false) {
    FrameResult f;
    f.clock = "a clock";
    f.passes = {
        {"a map", reused ? PassState::Cached : PassState::Drawn, "", shadow_ms, 0.1, 3, 100, PassCategory::Maps},
        {"shading", PassState::Drawn, "", shade_ms, 0.2, 5, 200},
        {"overlay", PassState::Skipped, "", 99, 99, 9, 900}};
    return f;
}

/// Clock that advances with frames and pauses.
struct FakeTime {
    double now = 1000;
    std::vector<double> pauses;
    BurstClock clock() {
        return {[this] { return now; },
                [this](double s) {
                    now += s;
                    pauses.push_back(s);
                }};
    }
};

TEST(TimeSampler, FirstFrameWarmsUpAndSkippedPassesDoNotCount) {
    TimeSampler sampler;
    double now = 7;
    sampler.add(frame_of(1000, 1000), now);
    for (int i = 0; i < 2; ++i) sampler.add(frame_of(2, 3), now += 0.005);
    const TimeMeasurement m = sampler.result();
    EXPECT_EQ(m.total_ms.samples, 2);
    EXPECT_DOUBLE_EQ(m.total_ms.median, 5);
    ASSERT_EQ(m.passes.size(), 2u);
    EXPECT_EQ(m.passes[1].name, "shading");
    EXPECT_DOUBLE_EQ(m.passes[1].gpu_ms.median, 3);
    EXPECT_EQ(m.clock, "a clock");
    EXPECT_DOUBLE_EQ(m.maps_ms.median, 2);
    EXPECT_DOUBLE_EQ(m.picture_ms.median, 3);
    EXPECT_NEAR(m.seconds, 0.01, 1e-9);
}

TEST(TimeSampler, SamplesOfSeveralTurnsAreMerged) {
    TimeSamples all, turn;
    for (const double ms : {1.0, 2.0}) turn.add(frame_of(ms, 3));
    all.add(turn);
    turn = {};
    turn.add(frame_of(5, 3));
    all.add(turn);
    const TimeMeasurement m = summarise_times(all);
    EXPECT_EQ(m.total_ms.samples, 3);
    EXPECT_DOUBLE_EQ(m.total_ms.median, 5);
    EXPECT_DOUBLE_EQ(m.maps_ms.high, 5);
    ASSERT_EQ(m.passes.size(), 2u);
    EXPECT_EQ(m.passes[0].gpu_ms.samples, 3);
    EXPECT_FALSE(m.settled);
}

TEST(TimeSampler, ContinuesUntilTheFigureIsStable) {
    FakeTime time;
    const auto draws = [&](double ms) { return time.now += ms / 1000, frame_of(ms, 0); };
    int calm = 0;
    EXPECT_TRUE(sample_times(
                    {}, [&] { return ++calm, draws(5); }, time.clock())
                    .settled);
    EXPECT_EQ(calm, 5 * 4) << "bursts of three and one that warms up";
    int wild = 0;
    const TimeMeasurement m = sample_times(
        {}, [&] { return draws(wild++ / 4 % 2 ? 10 : 1); }, time.clock());
    EXPECT_EQ(m.total_ms.samples, 60);
    EXPECT_FALSE(m.settled);
}

TEST(TimeSampler, BurstsAreSpreadOverASecond) {
    FakeTime time;
    const double start = time.now;
    const TimeMeasurement quick = sample_times(
        {}, [&] { return time.now += 0.004, frame_of(1, 3); }, time.clock());
    EXPECT_EQ(quick.total_ms.bursts, 5);
    // The last burst begins after four fifths of the second that follows the first frame, warms up, and has three
    // frames.
    EXPECT_NEAR(quick.seconds, 0.8 + 4 * 0.004, 1e-9);
    EXPECT_NEAR(time.now - start, 1 + 0.004, 0.2);
    EXPECT_EQ(time.pauses.size(), 4u);
    // Slow frames need neither pauses nor bursts of several.
    time.pauses.clear();
    const TimeMeasurement slow = sample_times(
        {}, [&] { return time.now += 0.5, frame_of(100, 400); }, time.clock());
    EXPECT_TRUE(time.pauses.empty());
    EXPECT_EQ(slow.total_ms.samples, 5);
    EXPECT_EQ(slow.total_ms.bursts, 5);
    EXPECT_GE(slow.seconds, 1);
}

TEST(TimeSampler, NoiseIsMeasuredBetweenBursts) {
    // A machine with a constant speed for one burst: each burst alone is stable.
    FakeTime time;
    const std::vector<double> moods = {29, 31, 33, 35, 40};
    std::size_t burst = 0;
    BurstClock clock = time.clock();
    clock.wait_s = [&](double s) {
        time.now += s;
        burst = std::min(burst + 1, moods.size() - 1);
    };
    const TimeMeasurement m = sample_times(
        {.most = 15}, [&] { return time.now += moods[burst] / 1000, frame_of(moods[burst], 0); }, clock);
    EXPECT_EQ(m.total_ms.samples, 15);
    EXPECT_EQ(m.total_ms.bursts, 5);
    EXPECT_DOUBLE_EQ(m.total_ms.median, 33);
    // Student's t of four degrees of freedom; the standard deviation of the burst means is 4.219.
    EXPECT_NEAR(0.5 * (m.total_ms.median_high - m.total_ms.median_low), 2.776 * 4.2190 / std::sqrt(5), 1e-3);
    EXPECT_FALSE(m.settled) << "by the ranks of fifteen frames alone it would be";
    EXPECT_NEAR(0.5 * (m.maps_ms.median_high - m.maps_ms.median_low), 5.238, 1e-3) << "of its parts likewise";
    TimeSamples two;
    two.add(frame_of(1, 0));
    two.burst_ended = true;
    two.add(frame_of(1, 0));
    EXPECT_FALSE(summarise_times(two).settled) << "two bursts tell nothing";
}

TEST(TimeSampler, WallTimeStandsBesideProcessorTime) {
    TimeSamples samples;
    for (const double wall_ms : {4, 6, 5}) {
        FrameResult f = frame_of(2, 3);
        f.passes[0].wall_ms = wall_ms;
        f.passes[1].wall_ms = 10;
        f.passes[2].wall_ms = 100;  // skipped
        samples.add(f);
    }
    TimeSamples twice = samples;
    twice.add(samples);
    EXPECT_EQ(twice.wall_ms.size(), 6u);
    const TimeMeasurement m = summarise_times(twice);
    ASSERT_TRUE(m.wall_ms);
    EXPECT_DOUBLE_EQ(m.wall_ms->median, 15);
    EXPECT_DOUBLE_EQ(m.total_ms.median, 5);

    TimeSamples other;
    other.add(frame_of(2, 3));
    EXPECT_FALSE(summarise_times(other).wall_ms) << "of a clock that is no processor time";
    EXPECT_EQ(time_unit("processor time (CPU rasteriser)"), "ms of processor");
    EXPECT_EQ(time_unit("GPU timer queries"), "ms");
}

TEST(TimeSampler, DepthBlurCountsAsMapTime) {
    FrameResult f = frame_of(2, 3);
    f.passes.push_back({"another change of the maps", PassState::Drawn, "", 7, 0, 0, 0, PassCategory::Maps});
    TimeSamples samples;
    samples.add(f);
    const TimeMeasurement m = summarise_times(samples);
    EXPECT_DOUBLE_EQ(m.maps_ms.median, 9);
    EXPECT_DOUBLE_EQ(m.picture_ms.median, 3);
}

TEST(WorkCost, CountsTexelsTapsAndDraws) {
    Settings s;
    s.map.resolution = 512;
    FrameResult f = frame_of(1, 1);
    f.map_resolution = 512;
    f.map_size = 512;
    f.colour = {.texture = 1, .width = 10, .height = 20};
    f.lights.resize(2);
    f.lights[0].casts = true;
    f.lights[0].views.resize(6);
    const WorkCost cost = work_cost(s, f);
    EXPECT_EQ(cost.map_texels, 6u * 512 * 512) << "the second light casts nothing";
    EXPECT_EQ(cost.map_bytes, 4 * cost.map_texels);
    EXPECT_EQ(cost.draws, 8u);
    EXPECT_EQ(cost.triangles, 300u);
    const int gathers = kernel_cost(s).gathers;
    EXPECT_EQ(cost.taps_per_pixel, 4.0 * gathers);
    EXPECT_EQ(cost.bytes_touched, cost.map_bytes + 10 * 20 * 4 * std::uint64_t(cost.taps_per_pixel));
    s.filter.method = FilterMethod::Sampler;
    s.map.format = MapFormat::D16;
    EXPECT_EQ(work_cost(s, f).map_bytes, 2 * cost.map_texels);
    // Blurred depths are a second set of maps, plus one map blurred along x as floats.
    s.map.blur_texels = 3;
    EXPECT_EQ(work_cost(s, f).map_bytes, 2 * 2 * cost.map_texels + 4 * 512 * 512);
    s.map.format = MapFormat::Colour;
    EXPECT_EQ(work_cost(s, f).map_bytes, (8 + 4) * cost.map_texels + 4 * 512 * 512) << "without a depth buffer";
    f.lights[0].casts = false;
    EXPECT_EQ(work_cost(s, f).map_bytes, 0u);
    s.map.format = MapFormat::D16;
    f.lights[0].casts = true;
    // A bilinear tap of a sampler compares 2x2 texels; a nearest one a single texel, as do nearest kernels by gathers.
    for (std::size_t i = 0; i < filters().size(); ++i) {
        s.filter.kernel = int(i);
        const Filter& f2 = filters()[i];
        if (!f2.square()) continue;
        const bool paired = is_bilinear(f2, s) && f2.cost != Filter::square_cost;
        const int across = paired ? taps_across(f2, s) / 2 + 1 : taps_across(f2, s);
        EXPECT_EQ(work_cost(s, f).taps_per_pixel, across * across * (is_bilinear(f2, s) ? 4 : 1)) << f2.key;
    }
    s.filter.kernel = Settings{}.filter.kernel;
    s.map.format = MapFormat::Colour;  // samplers cannot compare it
    EXPECT_EQ(work_cost(s, f).taps_per_pixel, 4.0 * gathers);
}

}  // namespace
}  // namespace si
