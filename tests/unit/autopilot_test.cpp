// Tests of the autopilot over made-up worlds, whose optimum exhaustive search finds.
#include "renderer/advise/autopilot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/settings/depth_compare.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

/// World in which finer maps, wider kernels and more cascades are more accurate and slower; cascades help each
/// resolution equally.
struct World {
    double now = 0;
    double seconds_each = 0;  ///< seconds a measured error or time
    double seconds_pair = 0;  ///< additional seconds of a paired time
    double ms_noise = 0;      ///< noise of a frame time
    int classified = 0, timed = 0;

    static double ms(const Settings& s) {
        return 1 + 1e-6 * s.lights[0].cascades * s.map.resolution * s.map.resolution +
               0.5 * kernel_cost(s).sampler_taps / 9.0 + (s.map.format == MapFormat::D16 ? 0 : 0.2) +
               10 * s.lights[0].contact;
    }
    static double error(const Settings& s) {
        return 2.0 / s.map.resolution / std::sqrt(double(taps_across(filter_of(s), s))) /
                   std::sqrt(double(s.lights[0].cascades)) +
               (s.map.format == MapFormat::D16 ? 1e-5 : 0) + (s.lights[0].contact > 0 ? 0 : 1e-5);
    }
    TrialMeter meter() {
        TrialMeter m;
        m.measure = [this](const Settings& s, int) {
            ++classified;
            now += seconds_each;
            const auto texels =
                std::uint64_t(s.lights[0].cascades) * std::uint64_t(s.map.resolution) * std::uint64_t(s.map.resolution);
            return MeasuredSettings{
                .error = error(s),
                .noise = 0,
                .work = {.map_texels = texels,
                         .map_bytes = texels * (s.map.format == MapFormat::D16 ? 2 : 4),
                         .bytes_touched = texels * 4 + std::uint64_t(kernel_cost(s).texels) * 1000}};
        };
        m.ms = [this](const Settings& s) { return ++timed, now += seconds_each, CostChange{ms(s), ms_noise}; };
        m.time = [this](const Settings& a, const Settings& b) {
            now += seconds_each + seconds_pair;
            return CostChange{ms(b) - ms(a), 1e-6};
        };
        m.now_s = [this] { return now; };
        return m;
    }
};

std::vector<SweepAxis> axes_of(bool many) {
    std::vector<SweepAxis> axes = {{"filter.kernel", {"", "hard", "pcf5", "pcf7"}},
                                   {"map.resolution", {"", "256", "512", "1024", "4096"}},
                                   {"light.0.cascades", {"", "2", "4"}}};
    if (many) {
        axes.push_back({"map.format", {"", "d16"}});
        axes.push_back({"light.0.contact", {"", "0"}});
    }
    return axes;
}

/// Returns the optimum by exhaustive search; nothing if no setting is within the bound.
std::optional<Settings> best_by_exhaustion(const Settings& start, const std::vector<SweepAxis>& axes,
                                           const AutopilotGoals& goals) {
    std::vector<Settings> all = {start};
    for (const SweepAxis& axis : axes) {
        std::vector<Settings> more;
        for (const Settings& s : all)
            for (const std::string& value : axis.values) {
                more.push_back(s);
                if (!value.empty()) set_setting(more.back(), axis.key, value);
            }
        all = std::move(more);
    }
    std::optional<Settings> best;
    for (const Settings& s : all) {
        if (goals.max_error && World::error(s) > *goals.max_error) continue;
        if (goals.max_ms && World::ms(s) > *goals.max_ms) continue;
        const auto cost = [&](const Settings& t) { return goals.max_error ? World::ms(t) : World::error(t); };
        if (!best || cost(s) < cost(*best)) best = s;
    }
    return best;
}

Settings with_contact() {
    Settings s;
    s.lights[0].contact = 0.1;
    return s;
}

TEST(Autopilot, FindsTheOptimumOfASmallSpace) {
    for (const AutopilotGoals& goals :
         {AutopilotGoals{.max_error = 0.001}, AutopilotGoals{.max_error = 0.0003}, AutopilotGoals{.max_ms = 4},
          AutopilotGoals{.max_ms = 2.5}, AutopilotGoals{.max_error = 0.002, .max_ms = 4}}) {
        World world;
        const AutopilotResult r = run_autopilot(with_contact(), axes_of(false), goals, world.meter());
        const std::optional<Settings> best = best_by_exhaustion(with_contact(), axes_of(false), goals);
        ASSERT_EQ(r.goals_met, best.has_value());
        const auto value = [&](const Settings& s) { return goals.max_error ? World::ms(s) : World::error(s); };
        EXPECT_NEAR(value(r.best.settings), value(*best), 1e-12) << r.summary;
        EXPECT_EQ(r.combinations, 60u);
        EXPECT_TRUE(r.untried.empty());
        EXPECT_LT(world.timed, 62) << "not all have to be timed";
    }
}

TEST(Autopilot, ComesWithinTenPercentInALargeSpace) {
    for (const double error : {0.003, 0.001, 0.0005, 0.0003}) {
        const AutopilotGoals goals{.max_error = error, .max_combinations = 100};
        World world;
        const AutopilotResult r = run_autopilot(with_contact(), axes_of(true), goals, world.meter());
        ASSERT_TRUE(r.goals_met) << r.summary;
        EXPECT_LE(World::ms(r.best.settings),
                  1.1 * World::ms(*best_by_exhaustion(with_contact(), axes_of(true), goals)))
            << r.summary;
        EXPECT_EQ(r.combinations, 240u);
        ASSERT_EQ(r.untried.size(), 1u) << "it says what it left out";
        EXPECT_LT(r.cases.size(), 180u) << "and that is a part of all";
    }
}

TEST(Autopilot, ShowsEachCombinationAsItIsMeasured) {
    World world;
    std::size_t shown = 0, best = 0;
    const AutopilotResult r = run_autopilot(
        with_contact(), axes_of(false), {.max_error = 0.002}, world.meter(), {}, [&](const AutopilotResult& so_far) {
            EXPECT_GE(so_far.cases.size(), shown);
            shown = so_far.cases.size();
            best += so_far.goals_met;
            EXPECT_EQ(so_far.combinations, 60u);
            EXPECT_NE(so_far.summary.find("of 60 combinations measured"), std::string::npos);
        });
    EXPECT_EQ(shown, r.cases.size());
    EXPECT_GT(best, 0u) << "the best so far is shown before the end";
}

TEST(Autopilot, ReportsTheCostOfEachDroppedEffect) {
    World world;
    const AutopilotGoals goals{.max_error = 0.003};
    const AutopilotResult r = run_autopilot(with_contact(), axes_of(true), goals, world.meter());
    ASSERT_TRUE(r.goals_met);
    const auto contact = std::find_if(r.dropped.begin(), r.dropped.end(),
                                      [](const SettingContribution& d) { return d.key == "light.0.contact"; });
    ASSERT_NE(contact, r.dropped.end());
    EXPECT_NEAR(contact->ms.value, 1, 1e-9);
    EXPECT_EQ(contact->before, "0.1");
    EXPECT_EQ(contact->now, "0");
    EXPECT_NEAR(contact->error, r.best.classified.error - 1e-5, 1e-12);
}

TEST(Autopilot, ReportsAnUnreachableBoundAndTheNearestResult) {
    World world;
    const AutopilotResult r = run_autopilot(Settings{}, axes_of(false), {.max_error = 1e-9}, world.meter());
    EXPECT_FALSE(r.goals_met);
    EXPECT_NE(r.summary.find("mae at most 0.000000001 cannot be met by any tried combination; the nearest is"),
              std::string::npos)
        << r.summary;
    for (const AutopilotCase& c : r.cases) EXPECT_LE(r.best.classified.error, c.classified.error);
    World fast;
    const AutopilotResult slow = run_autopilot(Settings{}, axes_of(false), {.max_ms = 0.01}, fast.meter());
    EXPECT_FALSE(slow.goals_met);
    EXPECT_NE(slow.summary.find("while the camera moves cannot be met"), std::string::npos) << slow.summary;
}

TEST(Autopilot, EndsInTimeAndReportsUntriedSettings) {
    World world;
    world.seconds_each = 1;
    const AutopilotResult r =
        run_autopilot(Settings{}, axes_of(false), {.max_error = 0.01, .max_seconds = 20}, world.meter());
    EXPECT_LE(r.seconds, 20 + 1) << "what was under way";
    EXPECT_FALSE(r.untried.empty());
    EXPECT_LT(r.cases.size(), 60u);
}

TEST(Autopilot, PricesNothingAfterTheTimeLimitAndReportsIt) {
    World world;
    world.seconds_each = 1;
    world.seconds_pair = 8;
    const std::vector<SweepAxis> axes = {
        {"map.resolution", {"", "256"}}, {"map.format", {"", "d16"}}, {"light.0.contact", {"", "0"}}};
    const AutopilotResult r =
        run_autopilot(with_contact(), axes, {.max_error = 0.05, .max_seconds = 30}, world.meter());
    ASSERT_TRUE(r.goals_met) << r.summary;
    EXPECT_EQ(r.best.axis_values, (std::vector<std::size_t>{1, 1, 1})) << "the search itself had time enough";
    EXPECT_EQ(r.dropped.size(), 2u);
    EXPECT_LE(r.seconds, 30 + 9) << "what was under way";
    ASSERT_EQ(r.untried.size(), 1u);
    EXPECT_EQ(r.untried[0], "the cost of light.0.contact was not measured: no time left");
}

TEST(Autopilot, ReservesTimeForPricingInALongSearch) {
    World world;
    world.seconds_each = 1;
    // No setting is better in everything than another, so all would be timed.
    const std::vector<SweepAxis> axes = {{"map.format", {"", "d16"}},
                                         {"light.0.contact", {"", "0", "0.02", "0.03", "0.04", "0.05"}}};
    const AutopilotResult r =
        run_autopilot(with_contact(), axes, {.max_error = 0.05, .max_seconds = 20}, world.meter());
    ASSERT_TRUE(r.goals_met) << r.summary;
    EXPECT_FALSE(r.untried.empty()) << "not all were timed";
    EXPECT_GE(r.dropped.size(), 1u);
    EXPECT_LE(r.seconds, 20 + 1) << "what was under way";
}

TEST(Autopilot, TurnsOffOnlyActiveEffects) {
    AdviceFacts f;
    f.lights.resize(1);
    f.lights[0].shadowed = f.lights[0].casts = true;
    f.lights[0].views.resize(1);
    f.shadowed = {0.5};
    const auto has = [](const std::vector<SweepAxis>& axes, std::string_view key) {
        return std::any_of(axes.begin(), axes.end(), [&](const SweepAxis& a) { return a.key == key; });
    };
    const std::vector<SweepAxis> plain = autopilot_axes(Settings{}, f, 4096);
    EXPECT_TRUE(has(plain, "filter.kernel"));
    EXPECT_TRUE(has(plain, "map.resolution"));
    for (const char* key : {"light.0.contact", "map.virtual", "light.0.cast"}) EXPECT_FALSE(has(plain, key)) << key;
    f.shadowed = {0};
    EXPECT_TRUE(has(autopilot_axes(with_contact(), f, 4096), "light.0.cast"));
    EXPECT_TRUE(has(autopilot_axes(with_contact(), f, 4096), "light.0.contact"));
    for (const SweepAxis& axis : plain) EXPECT_EQ(axis.values.front(), "") << "as it is";
}

TEST(Autopilot, VariesNothingThatNeedsAnotherMapFromTheEngine) {
    MeasuredError frame;
    frame.lights.resize(2);
    frame.lights[0].provider = MapProvider::Imported;
    const auto shared = std::make_shared<const MeasuredError>(frame);
    World world;
    TrialMeter meter = world.meter();
    meter.measure = [&, measure = meter.measure](const Settings& s, int light) {
        MeasuredSettings measured = measure(s, light);
        measured.frame = shared;
        return measured;
    };
    const std::vector<SweepAxis> axes = {{"filter.kernel", {"", "hard", "pcf5"}},
                                         {"map.resolution", {"256", "512"}},
                                         {"light.0.fit", {"", "view"}},
                                         {"light.1.fit", {"", "view"}}};
    const AutopilotResult r = run_autopilot(Settings{}, axes, {.max_error = 1.0}, meter);
    EXPECT_EQ(r.combinations, 6u) << "light 1 has drawn maps";
    ASSERT_EQ(r.cases.size(), 6u);
    for (const AutopilotCase& c : r.cases) {
        EXPECT_EQ(c.settings.map.resolution, Settings{}.map.resolution);
        EXPECT_EQ(c.settings.lights[0].fit, Settings{}.lights[0].fit);
    }
    ASSERT_EQ(r.untried.size(), 2u);
    EXPECT_EQ(r.untried[0], "map.resolution was not varied: it needs another map from the engine");
    EXPECT_EQ(r.untried[1], "light.0.fit was not varied: it needs another map from the engine");
}

/// A time within noise of the limit decides nothing.
TEST(Autopilot, HoldsIsUnknownWithinNoiseAndWithoutATime) {
    World world{.ms_noise = 1e9};
    const AutopilotResult r = run_autopilot(Settings{}, axes_of(false), {.max_ms = 4}, world.meter());
    EXPECT_FALSE(r.goals_met);
    for (const AutopilotCase& c : r.cases) EXPECT_FALSE(c.holds);
    World sure;
    const AutopilotResult known = run_autopilot(Settings{}, axes_of(false), {.max_error = 0.001}, sure.meter());
    for (const AutopilotCase& c : known.cases)
        if (!c.ms) {
            const bool is_accurate = c.classified.error <= 0.001;
            EXPECT_EQ(c.holds, is_accurate ? std::nullopt : std::optional(false)) << "the error alone may decide";
        }
    EXPECT_TRUE(std::ranges::any_of(known.cases, [](const AutopilotCase& c) { return !c.ms && c.holds; }));
    EXPECT_TRUE(std::ranges::any_of(known.cases, [](const AutopilotCase& c) { return !c.holds; }));
}

TEST(Autopilot, AnotherKindOfBiasBringsItsStartingValues) {
    World world;
    const AutopilotResult r = run_autopilot(Settings{}, {{"bias.kind", {"", "slope"}}}, {}, world.meter());
    ASSERT_EQ(r.cases.size(), 2u);
    for (const AutopilotCase& c : r.cases) EXPECT_EQ(c.settings.bias.normal, c.axis_values[0] == 1 ? 3 : 0);
    const AutopilotResult held =
        run_autopilot(Settings{}, {{"bias.kind", {"", "slope"}, {"bias.normal"}}}, {}, world.meter());
    for (const AutopilotCase& c : held.cases) EXPECT_EQ(c.settings.bias.normal, 0);
}

/// A search that is stopped keeps the best case so far.
TEST(Autopilot, StopsWithWhatIsThere) {
    World world;
    int measured = 0;
    TrialMeter meter = world.meter();
    meter.measure = [&, measure = meter.measure](const Settings& s, int light) {
        if (++measured > 20) throw Cancelled();
        return measure(s, light);
    };
    const AutopilotResult r = run_autopilot(Settings{}, axes_of(false), {.max_error = 0.01}, meter);
    EXPECT_TRUE(r.stopped);
    EXPECT_EQ(r.cases.size(), 20u);
    EXPECT_FALSE(r.untried.empty());
    EXPECT_TRUE(r.goals_met) << "the present settings are within the limit: " << r.summary;
    measured = 0;
    World coarse;
    meter.ms = coarse.meter().ms;
    Settings far_off;
    far_off.map.resolution = 64;
    const AutopilotResult untimed = run_autopilot(far_off, axes_of(false), {.max_error = 0.001}, meter);
    EXPECT_FALSE(untimed.goals_met);
    ASSERT_LE(untimed.best.classified.error, 0.001);
    EXPECT_EQ(untimed.summary.rfind("stopped before a combination with mae at most 0.001 was timed; ", 0), 0u)
        << untimed.summary;
    // A timed case that holds is not lost.
    World timed;
    meter = timed.meter();
    int times = 0;
    meter.ms = [&, ms = meter.ms](const Settings& s) {
        if (++times > 2) throw Cancelled();
        return ms(s);
    };
    const AutopilotResult held = run_autopilot(Settings{}, axes_of(false), {.max_error = 0.01}, meter);
    EXPECT_TRUE(held.stopped);
    EXPECT_TRUE(held.goals_met) << held.summary;
    EXPECT_LE(held.best.classified.error, 0.01);
}

}  // namespace
}  // namespace si
