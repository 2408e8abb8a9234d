// Tests of advice: rules over made-up facts, and measured ideas under a made-up clock and reference.
#include "renderer/advise/advice.h"

#include <gtest/gtest.h>

#include <set>

#include "renderer/inspect/given_map_changes.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

/// Returns facts that no rule proposes a change for.
AdviceFacts plain_facts() {
    AdviceFacts f;
    f.lights.resize(1);
    f.lights[0].shadowed = f.lights[0].casts = true;
    f.lights[0].views.resize(1);
    f.map_resolution = 2048;
    f.map_size = 2048;
    f.pixels = f.error.counted = 1000;
    f.nearest_m = 2;
    f.farthest_m = 14;
    f.texel_px = 2;
    f.penumbra_texels = 10;
    f.read_share = 0.6;
    f.shadowed = {0.2};
    f.lights[0].limits.depth_m = 20;
    f.lights[0].limits.texel_m = 1e-5;
    return f;
}

std::vector<Candidate> ideas_of(const Settings& s, const AdviceFacts& f, std::string_view rule) {
    std::vector<Candidate> ideas = advice_candidates(s, f);
    std::erase_if(ideas, [&](const Candidate& i) { return i.rule != rule; });
    return ideas;
}

TEST(AdviceRules, FireWhenTheirFactsHold) {
    struct Case {
        const char* rule;
        std::function<void(Settings&, AdviceFacts&)> change;
        const char* sets;  ///< KEY=VALUE of the first expected idea
        const char* says;
    };
    const std::vector<Case> cases = {
        {"no-shadow", [](Settings&, AdviceFacts& f) { f.shadowed[0] = 0; }, "light.cast=false", "light 0"},
        {"narrow-penumbra",
         [](Settings& s, AdviceFacts& f) {
             set_setting(s, "filter.kernel", "pcss");
             f.penumbra_texels = 0.4;
         },
         "filter.kernel=hw2x2",
         "the penumbra is at most 0.4 texels wide here: PCSS has no advantage over 2×2 bilinear"},
        {"cascades",
         [](Settings& s, AdviceFacts& f) {
             s.lights[0].cascades = 4;
             f.lights[0].views.resize(4);
             f.lights[0].chooser.choice = ViewChoice::Interval;
         },
         "light.cascades=1", "12 m of depth (2 m to 14 m): 1 of 4 cascades suffices"},
        {"cascade-overlap",
         [](Settings& s, AdviceFacts& f) {
             s.lights[0].cascades = 4;
             f.lights[0].views.resize(4);
             f.lights[0].chooser.choice = ViewChoice::Interval;
         },
         "light.cascade_blend=0", "10 %"},
        {"unread-texels", [](Settings&, AdviceFacts& f) { f.read_share = 0.08; }, "map.resolution=1024",
         "8 % of the map's texels are read: a tighter fit gives the same sharpness at 1024"},
        {"fine-map", [](Settings&, AdviceFacts& f) { f.texel_px = 0.2; }, "map.resolution=1024", "0.2 pixels"},
        {"unseen-blur", [](Settings&, AdviceFacts& f) { f.texel_px = 0.2; }, "filter.kernel=hard",
         "which is invisible"},
        {"moments", [](Settings& s, AdviceFacts&) { set_setting(s, "filter.kernel", "vsm"); }, "filter.kernel=pcf",
         "direct comparison"},
        {"bias",
         [](Settings&, AdviceFacts& f) {
             const Bias& row = bias_of_stage(BiasStage::LookUp);
             f.starts = {{&row, {.normal = 1}}};
         },
         "bias.normal=1", "need no more than"},
        {"polygon-offset", [](Settings& s, AdviceFacts&) { s.bias.raster_slope = 2; }, "bias.raster_slope=0",
         "slope 2"},
        {"sixteen-bits",
         [](Settings&, AdviceFacts& f) {
             f.lights[0].limits.texel_m = 0.01;
             f.lights[0].limits.depth_m = 3;  // of the scene
             f.lights[0].views[0].curve = {.near = 5, .far = 25};
         },
         "map.format=d16", "20 m of depth in 16 bits"},
        {"contact", [](Settings& s, AdviceFacts&) { s.lights[0].contact = 0.2; }, "light.contact=0", "200 mm"},
        {"whole-map",
         [](Settings& s, AdviceFacts& f) {
             s.map.paged = true;
             f.paged_texels = 1'000'000;
         },
         "map.virtual=false", "1024"},
        {"depth-blur", [](Settings& s, AdviceFacts&) { s.map.blur_texels = 3; }, "map.blur_texels=0", "3 texels"},
        {"map-samples", [](Settings& s, AdviceFacts&) { s.map.samples = 4; }, "map.samples=1", "4 samples"},
        {"gathers", [](Settings& s, AdviceFacts&) { s.filter.method = FilterMethod::Sampler; }, "filter.method=auto",
         "gathers give the same picture"},
        {"separate-visibility", [](Settings& s, AdviceFacts&) { s.shading.separate_visibility = true; },
         "shading.separate_visibility=false", "a pass of its own"},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.rule);
        Settings s;
        AdviceFacts f = plain_facts();
        EXPECT_TRUE(ideas_of(s, f, c.rule).empty()) << "plain facts call for nothing";
        c.change(s, f);
        const std::vector<Candidate> ideas = ideas_of(s, f, c.rule);
        ASSERT_FALSE(ideas.empty());
        EXPECT_NE(ideas[0].name.find(c.says), std::string::npos) << ideas[0].name;
        const std::string_view sets = c.sets;
        const std::string key(sets.substr(0, sets.find('='))), value(sets.substr(sets.find('=') + 1));
        const SettingRef ref = *find_setting(key);
        EXPECT_EQ(value_text(*ref.param, get_value(ideas[0].settings, ref)), value);
    }
}

TEST(AdviceRules, ProposeEachChangeOnce) {
    Settings s;
    AdviceFacts f = plain_facts();
    f.texel_px = 0.1;
    f.read_share = 0.05;
    f.shadowed[0] = 0;
    const std::vector<Candidate> ideas = advice_candidates(s, f);
    ASSERT_GT(ideas.size(), 4u);
    for (std::size_t i = 0; i < ideas.size(); ++i) {
        EXPECT_FALSE(ideas[i].settings == s) << ideas[i].name;
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_FALSE(ideas[i].claim == ideas[k].claim && ideas[i].settings == ideas[k].settings);
    }
    std::set<std::string_view> keys;
    for (const AdviceRule& rule : advice_rules()) EXPECT_TRUE(keys.insert(rule.key).second) << rule.key;
}

TEST(AdviceRules, ProposeNothingForAnEmptyScene) {
    AdviceFacts f;
    f.lights.resize(1);
    f.shadowed = {std::numeric_limits<double>::quiet_NaN()};
    f.texel_px = f.shadowed[0];
    EXPECT_TRUE(advice_candidates(Settings{}, f).empty());
    f.lights.clear();
    f.shadowed.clear();
    EXPECT_TRUE(advice_candidates(Settings{}, f).empty()) << "without lights";
}

/// Meter of error, milliseconds and bytes by map.resolution, which numbers the ideas.
struct MadeUp {
    double error, ms, noise = 0.1;
    std::uint64_t bytes = 100;
};

std::vector<Trial> tried_ideas(const std::vector<MadeUp>& world, const std::vector<Claim>& claims) {
    std::vector<Candidate> ideas;
    for (std::size_t i = 1; i < world.size(); ++i) {
        Candidate idea{.name = std::to_string(i), .rule = "made up", .claim = claims[i - 1]};
        idea.settings.map.resolution = int(i);
        ideas.push_back(idea);
    }
    Settings base;
    base.map.resolution = 0;
    TrialMeter meter;
    meter.measure = [&](const Settings& s, int) {
        const MadeUp& w = world[std::size_t(s.map.resolution)];
        return MeasuredSettings{.error = w.error, .noise = 0, .work = {.bytes_touched = w.bytes}};
    };
    meter.time = [&](const Settings& a, const Settings& b) {
        const MadeUp &x = world[std::size_t(a.map.resolution)], &y = world[std::size_t(b.map.resolution)];
        return CostChange{y.ms - x.ms, y.noise};
    };
    return try_advice(base, ideas, meter);
}

TEST(Advice, IsRankedBySavedTimePerAddedError) {
    constexpr Claim kSame = Claim::Same, kTrade = Claim::Trade, kRight = Claim::Right;
    const std::vector<MadeUp> world = {
        {0.010, 10},
        {0.010, 9},              // 1: saves 1 ms without error
        {0.030, 4},              // 2: 6 ms for 0.02: 300 a unit of error
        {0.012, 8},              // 3: 2 ms for 0.002: 1000 a unit of error
        {0.010, 7},              // 4: saves 3 ms without error
        {0.005, 10},             // 5: cures pixels
        {0.010, 10, 0.1, 50},    // 6: saves memory
        {0.020, 5},              // 7: claims to be equal and is not
        {0.010, 12},             // 8: slower
        {0.010, 9.95, 0.1, 100}  // 9: no effect
    };
    const auto all = tried_ideas(world, {kSame, kTrade, kTrade, kSame, kRight, kSame, kSame, kTrade, kSame});
    std::vector<std::string> holds, fails;
    for (const Trial& t : all) (t.why_not.empty() ? holds : fails).push_back(t.candidate.name);
    EXPECT_EQ(holds, (std::vector<std::string>{"5", "4", "1", "3", "2", "6"}));
    EXPECT_EQ(std::set<std::string>(fails.begin(), fails.end()), (std::set<std::string>{"7", "8", "9"}));
    for (const Trial& t : all) {
        if (t.candidate.name == "7") {
            EXPECT_NE(t.why_not.find("the error grows by 0.01"), std::string::npos);
        }
        if (t.candidate.name == "8") {
            EXPECT_NE(t.why_not.find("2 ms more"), std::string::npos);
        }
        EXPECT_EQ(t.changes.size(), 1u);
    }
}

TEST(Advice, ChangeWithARefutedClaimIsOfferedAsATrade) {
    int classified = 0;
    TrialMeter meter;
    meter.measure = [&](const Settings& s, int) {
        return ++classified,
               MeasuredSettings{.error = s.map.resolution == 1 ? 0.03 : 0.01, .noise = 0, .work = {}, .camera = {}};
    };
    meter.time = [](const Settings&, const Settings&) { return CostChange{-5, 0.1}; };
    Candidate same{.name = "the same", .settings = {}, .rule = "a", .claim = Claim::Same};
    same.settings.map.resolution = 1;
    Candidate trade = same;
    trade.claim = Claim::Trade;
    trade.name = "coarser";
    const std::vector<Trial> all = try_advice(Settings{}, {same, trade}, meter);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].candidate.name, "coarser");
    EXPECT_TRUE(all[0].why_not.empty());
    EXPECT_EQ(classified, 2) << "before, and once after";
}

TEST(Advice, AChangeThatNeedsAnotherMapIsNotDrawnUnderASecondClaim) {
    MeasuredError frame;
    frame.lights.resize(1);
    frame.lights[0].provider = MapProvider::Imported;
    TrialMeter meter;
    meter.measure = [shared = std::make_shared<const MeasuredError>(frame)](const Settings&, int) {
        return MeasuredSettings{.error = 0.01, .noise = 0, .work = {}, .camera = {}, .frame = shared};
    };
    meter.time = [](const Settings&, const Settings&) { return CostChange{-5, 0.1}; };
    Candidate same{.name = "the same", .settings = {}, .rule = "a", .claim = Claim::Same};
    same.settings.map.resolution = 1;
    Candidate trade = same;
    trade.claim = Claim::Trade;
    trade.name = "coarser";
    const std::vector<Trial> all = try_advice(Settings{}, {same, trade}, meter);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].candidate.name, "the same");
    EXPECT_EQ(all[0].candidate.untried, kNeedsAnotherMap);
    EXPECT_EQ(all[0].why_not, kNeedsAnotherMap);
    EXPECT_FALSE(all[0].ms);
}

/// A change that lowers the error is advice whichever rule proposed it.
TEST(Advice, AChangeThatLowersTheErrorHoldsUnderAnyClaim) {
    for (const Claim claim : {Claim::Same, Claim::Right, Claim::Trade}) {
        const auto all = tried_ideas({{0.159, 10}, {0.037, 10.05}}, {claim});
        EXPECT_EQ(all[0].why_not, "");
    }
}

/// A change within the noise of time and error is no advice.
TEST(Advice, NothingIsDecidedWithinNoise) {
    for (const Claim claim : {Claim::Same, Claim::Right, Claim::Trade}) {
        const auto all = tried_ideas({{0.0100, 10}, {0.00999, 9.95, 0.1}}, {claim});
        EXPECT_NE(all[0].why_not, "");
    }
}

TEST(Advice, AStoppedSearchKeepsItsTrials) {
    int steps = 0;
    TrialMeter meter;
    meter.measure = [](const Settings&, int) {
        return MeasuredSettings{.error = 1, .noise = 0, .work = {}, .camera = {}};
    };
    meter.time = [](const Settings&, const Settings&) { return CostChange{-5, 0.1}; };
    std::vector<Candidate> list(3, {.name = "a", .settings = {}, .claim = Claim::Same});
    for (int i = 0; i < 3; ++i) list[std::size_t(i)].settings.map.resolution = i + 1;
    const auto stop = [&](double, const std::string&) {
        if (++steps == 3) throw Cancelled();
    };
    EXPECT_EQ(try_advice(Settings{}, list, meter, stop).size(), 2u);
    steps = 2;
    EXPECT_THROW(try_advice(Settings{}, list, meter, stop), Cancelled) << "nothing was tried";
}

TEST(Advice, ClaimsOfCuredPixelsAreVerified) {
    const auto all = tried_ideas({{0.010, 10}, {0.010, 5}, {0.002, 20}}, {Claim::Right, Claim::Right});
    EXPECT_TRUE(all[0].why_not.empty()) << "right, at whatever cost";
    EXPECT_EQ(all[0].candidate.name, "2");
    EXPECT_NE(all[1].why_not.find("does not fall"), std::string::npos);
}

TEST(Advice, ChangesThatTheErrorRefutesAreNotTimed) {
    const auto all =
        tried_ideas({{0.010, 10}, {0.020, 5}, {0.010, 5}, {0.010, 5}}, {Claim::Same, Claim::Right, Claim::Same});
    for (const Trial& t : all) EXPECT_EQ(t.ms.has_value(), t.candidate.name == "3") << t.candidate.name;
}

TEST(Advice, CameraChangesAreNotMeasured) {
    Candidate idea{.name = "turn", .settings = {}, .rule = "made up"};
    idea.settings.map.resolution = 1;
    TrialMeter meter;
    meter.measure = [](const Settings& s, int) {
        MeasuredSettings j;
        j.camera.eye.x = s.map.resolution;
        return j;
    };
    meter.time = [](const Settings&, const Settings&) { return CostChange{-5, 0.1}; };
    EXPECT_NE(try_advice(Settings{}, {idea}, meter)[0].why_not.find("would move"), std::string::npos);
}

TEST(Findings, AreSortedBySeverityWithTheirBestFix) {
    AdviceFacts f = plain_facts();
    f.notes = {"map.resolution was lowered"};
    f.lights[0].limits.one_texel = true;
    f.error.artefacts[std::size_t(Artefact::Acne)] = 200;
    f.error.artefacts[std::size_t(Artefact::EdgeAliasing)] = 2;
    FixTable fixes;
    fixes.wrong = 202;
    Trial little{.candidate = {.name = "little", .settings = {}}};
    little.cured = 50;
    little.cured_of[std::size_t(Artefact::Acne)] = 50;
    Trial most = little;
    most.candidate.name = "most";
    most.changes = {{"bias.normal", "3"}};
    most.cured = 190;
    most.broken = 1;
    most.cured_of[std::size_t(Artefact::Acne)] = 190;
    most.metrics.artefacts[std::size_t(Artefact::Acne)] = 13;
    Trial harm = little;
    harm.candidate.name = "harm";
    harm.cured_of[std::size_t(Artefact::Acne)] = 200;
    harm.why_not = "wrong pixels rise";
    fixes.rows = {little, most, harm};
    const std::vector<Finding> found = list_findings(f, fixes);
    ASSERT_EQ(found.size(), 4u);
    EXPECT_EQ(found[0].severity, Severity::Error);
    for (std::size_t i = 1; i < found.size(); ++i) EXPECT_LE(found[i - 1].severity, found[i].severity);
    const auto acne = std::find_if(found.begin(), found.end(), [](const Finding& x) {
        return x.text.find("200 pixels, 20 %") != std::string::npos;
    });
    ASSERT_NE(acne, found.end());
    EXPECT_EQ(acne->fix, "most puts 190 of them right; 13 px are wrong then instead of 202");
    EXPECT_EQ(acne->settings.front().second, "3");
}

}  // namespace
}  // namespace si
