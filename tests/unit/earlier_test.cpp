// Files of earlier versions mean what they meant, and names that were given up are read.
#include "renderer/settings/earlier.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/base/output.h"
#include "app/session/presets.h"
#include "app/session/session.h"
#include "app/sweep/state.h"
#include "renderer/base/error.h"
#include "renderer/measure/axes.h"
#include "renderer/settings/aliases.h"
#include "renderer/settings/filters.h"
#include "tests/support/version_1.h"

namespace si {
namespace {

using test::version_1_defaults;
using OrderedJson = nlohmann::ordered_json;

/// The one setting of version 1 whose default has been another one since.
constexpr const char* kChanged = "light.fit";

std::string preset_of(int version, const std::string& settings) {
    return R"({"format":"shadow-inspector-preset","version":)" + std::to_string(version) + R"(,"settings":{)" +
           settings + "}}";
}

TEST(EarlierVersions, EveryDefaultOfVersionOneIsKnown) {
    const Settings s = defaults_of_version(1);
    const auto defaults = version_1_defaults();
    EXPECT_EQ(defaults.size(), 97u) << "the file of version 1's defaults is not to be edited";
    for (const auto& [key, value] : defaults.items()) {
        const auto ref = find_setting(key);
        ASSERT_TRUE(ref) << key << " was renamed: it needs an alias";
        const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
        EXPECT_EQ(get_value(s, *ref), parse_value(*ref, text))
            << key << " had another default up to version 1: it needs a row of earlier_defaults()";
    }
}

TEST(EarlierVersions, TheRowsAreOfSettingsThatDiffer) {
    for (const EarlierDefault& row : earlier_defaults()) {
        ASSERT_TRUE(find_setting(row.key)) << row.key;
        EXPECT_LT(row.version, kSettingsVersion) << row.key;
        EXPECT_NO_THROW(parse_value(*find_setting(row.key), row.value)) << row.key;
    }
    EXPECT_EQ(defaults_of_version(kSettingsVersion), Settings());
}

TEST(EarlierVersions, AFileOfOneSpeaksOfTheLightsThatItHas) {
    const Settings s = parse_preset(preset_of(1, R"("light.count":2,"light.4.azimuth":7)"), "a.json").settings;
    const Settings old = defaults_of_version(1), now;
    for (const int i : {0, 1, 2, 3, 4}) EXPECT_EQ(s.lights[std::size_t(i)].fit, old.lights[0].fit) << i;
    EXPECT_EQ(s.lights[5], now.lights[5]) << "what is added later is of today";
    EXPECT_EQ(parse_preset(preset_of(kSettingsVersion, R"("light.count":2)"), "a.json").settings.lights[0].fit,
              now.lights[0].fit);
    EXPECT_EQ(parse_preset(preset_of(1, R"("light.1.fit":"manual")"), "a.json").settings.lights[1].fit,
              int(LightFit::Manual))
        << "what the file says holds";
}

TEST(EarlierVersions, WrittenAgainAPresetMeansTheSame) {
    for (const auto& file : test::version_1_presets()) {
        const Preset preset = parse_preset(read_text_file(file), file.string());
        EXPECT_EQ(preset.settings, test::version_1_settings(file)) << file;
        const std::string text = preset_text(preset);
        EXPECT_EQ(OrderedJson::parse(text)["version"], kSettingsVersion);
        EXPECT_EQ(parse_preset(text, "again").settings, preset.settings) << file;
    }
    EXPECT_EQ(test::version_1_presets().size(), 39u);
}

TEST(EarlierVersions, AJournalOfOneIsReadWithTheDefaultsOfOne) {
    const auto state_of = [](int version, OrderedJson settings, OrderedJson axes) {
        const OrderedJson spec = {{"scene", {{"name", "boxes"}, {"triangles", 12}, {"content", "00000000000000ff"}}},
                                  {"picture", {{"width", 64}, {"height", 36}}},
                                  {"truth", "hard"},
                                  {"settings", std::move(settings)},
                                  {"axes", std::move(axes)},
                                  {"shard", "1/1"}};
        SweepState state;
        state.apply(
            {{"format", "shadow-inspector-sweep-journal"}, {"version", version}, {"plan", "x"}, {"spec", spec}});
        return spec_from_json(state.spec).base;
    };
    const auto old = defaults_of_version(1).lights[0].fit;
    const Settings now;
    const Settings one = state_of(1, {{"bias.constant", "0.5"}}, OrderedJson::array());
    EXPECT_EQ(one.bias.constant, 0.5);
    EXPECT_EQ(one.lights[0].fit, old);
    EXPECT_EQ(one.lights[1], now.lights[1]);
    const Settings varied = state_of(1, OrderedJson::object(), {{{"key", "light.count"}, {"values", {"1", "3"}}}});
    EXPECT_EQ(varied.lights[2].fit, old) << "some of the cases have three lights";
    EXPECT_EQ(varied.lights[3], now.lights[3]);
    EXPECT_EQ(state_of(kSettingsVersion, OrderedJson::object(), OrderedJson::array()), now);
    EXPECT_THROW(state_of(kSettingsVersion + 1, OrderedJson::object(), OrderedJson::array()), Error);
}

/// Names that nothing has had, for what there is.
constexpr SettingAlias kOldKeys[] = {{.was = "bias.amount", .key = "bias.constant"},
                                     {.was = "light.heading", .key = "light.azimuth"},
                                     {.was = "object.side", .key = "object.cull"}};
constexpr ChoiceAlias kOldChoices[] = {
    {.key = "filter.kernel", .was = "blocky", .choice = "hard"},
    {.key = "filter.kernel",
     .was = "wide_gathered",
     .choice = "poisson",
     .also = {{{"filter.method", "gather"}, {"bias.constant", "2"}}}},
    {.key = "light.type", .was = "sun", .choice = "directional"},
};
constexpr Aliases kOldNames{kOldKeys, kOldChoices};

TEST(Aliases, AreReadWhereverSettingsAre) {
    const TrialAliases trial(kOldNames);
    Settings s, expected;
    apply_set(s, "bias.amount=3");
    apply_set(s, "light.2.heading=5");
    apply_set(s, "object.Root/Box.side=front");
    apply_set(s, "filter.kernel=blocky");
    apply_set(expected, "bias.constant=3");
    apply_set(expected, "light.2.azimuth=5");
    apply_set(expected, "object.Root/Box.cull=front");
    apply_set(expected, "filter.kernel=hard");
    EXPECT_EQ(s, expected);
    const Preset preset = parse_preset(
        preset_of(1, R"("bias.amount":3,"light.2.heading":5,"object.Root/Box.side":"front","filter.kernel":"blocky")"),
        "a.json");
    for (const SettingRef& ref : changed_settings(expected))
        EXPECT_EQ(get_value(preset.settings, ref), get_value(expected, ref)) << setting_key(ref);
    const SweepAxis axis = parse_axis("light.1.heading=10,20");
    EXPECT_EQ(axis.key, "light.1.azimuth");
    EXPECT_EQ(parse_axis("filter.kernel=blocky,hard,pcf").values, (std::vector<std::string>{"hard", "pcf"}));
    EXPECT_EQ(parse_axis("light.1.type=sun,spot").values, (std::vector<std::string>{"directional", "spot"}));
}

TEST(Aliases, AnOldChoiceMaySayWhatSeveralSettingsSayNow) {
    const TrialAliases trial(kOldNames);
    Settings expected;
    for (const char* set : {"filter.kernel=poisson", "filter.method=gather", "bias.constant=2"})
        apply_set(expected, set);
    Settings s;
    apply_set(s, "filter.kernel=wide_gathered");
    EXPECT_EQ(s, expected);
    EXPECT_EQ(parse_preset(preset_of(kSettingsVersion, R"("filter.kernel":"wide_gathered")"), "a.json").settings,
              expected);
    const SweepAxis axis = parse_axis("filter.kernel=hard,wide_gathered");
    EXPECT_EQ(axis.values, (std::vector<std::string>{"hard", "wide_gathered"}));
    const SweepPlan plan = plan_sweep({}, {axis});
    ASSERT_EQ(plan.cases.size(), 2u);
    EXPECT_EQ(plan.cases[1].settings, expected);
    try {
        parse_preset(preset_of(2, R"("filter.kernel":"wide_gathered","bias.constant":1)"), "a.json");
        ADD_FAILURE() << "the constant stands there twice";
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("the same setting as \"filter.kernel\""), std::string::npos) << e.what();
    }
}

// The squares that were rows of their own: in commands, presets of every version and journals, for good.
TEST(Aliases, OfSquareKernelsSayWhatTheyWere) {
    struct Was {
        const char* key;
        int size;
        bool point;
    };
    for (const Was& was : {Was{"pcf3", 3, false},
                           {"pcf5", 5, false},
                           {"pcf7", 7, false},
                           {"pcf9", 9, false},
                           {"pcf3_nearest", 3, true},
                           {"pcf5_nearest", 5, true}}) {
        SCOPED_TRACE(was.key);
        const std::string text = fmt::format("\"filter.kernel\":\"{}\"", was.key);
        Settings set;
        set.filter.size = 12;
        set.filter.point = !was.point;  // which the old key said nothing of
        apply_set(set, fmt::format("filter.kernel={}", was.key));
        for (const Settings& s :
             {set, parse_preset(preset_of(1, text), "a.json").settings,
              parse_preset(preset_of(kSettingsVersion, text), "a.json").settings,
              plan_sweep({}, {parse_axis(fmt::format("filter.kernel={}", was.key))}).cases.at(0).settings}) {
            EXPECT_EQ(filter_of(s).key, "pcf");
            EXPECT_EQ(s.filter.size, was.size);
            EXPECT_EQ(s.filter.point, was.point);
        }
    }
    EXPECT_EQ(filter_of(Settings{}).key, "pcf");
    EXPECT_EQ(Settings{}.filter.size, 3);
}

TEST(Aliases, AreNeitherListedNorProposed) {
    const TrialAliases trial(kOldNames);
    const auto message = [](const char* set) -> std::string {
        try {
            Settings s;
            apply_set(s, set);
        } catch (const UsageError& e) {
            return e.what();
        }
        return {};
    };
    EXPECT_EQ(message("bias.amont=1"), "\"bias.amont\": unknown setting") << "like nothing of today";
    EXPECT_EQ(message("filter.kernel=block").find("blocky"), std::string::npos);
    EXPECT_NE(message("bias.amount=nothing").find("bias.constant"), std::string::npos) << "today's name explains";
}

TEST(Aliases, LeadToWhatThereIs) {
    for (const SettingAlias& a : aliases().settings) {
        EXPECT_TRUE(find_setting(a.was)) << a.was;
        for (const Param& p : params()) EXPECT_NE(p.key, a.was) << "has that name today";
    }
    for (const ChoiceAlias& a : aliases().choices) {
        Settings s;
        EXPECT_NO_THROW(set_setting(s, a.key, a.was)) << a.key << " " << a.was;
        for (const Choice& c : find_setting(a.key)->param->choices()) EXPECT_NE(c.key, a.was) << a.key;
    }
}

}  // namespace
}  // namespace si
