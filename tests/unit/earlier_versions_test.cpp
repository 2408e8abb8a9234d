// Tests of files of earlier versions, read with the defaults of those versions, and of names that set kernel size and
// sampling.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/base/output.h"
#include "app/session/presets.h"
#include "app/session/session.h"
#include "app/sweep/state.h"
#include "renderer/base/error.h"
#include "renderer/measure/axes.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/earlier.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/sized_kernels.h"
#include "tests/support/error_text.h"
#include "tests/support/sets.h"

namespace si {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr const char* kDefaultBias = "";
constexpr const char* kOtherBias = R"("bias.kind":"constant","bias.constant":0.5,"filter.kernel":"hard")";

/// Made-up defaults: light.fit changed once, map.resolution twice.
constexpr EarlierDefault kTrialRows[] = {
    {.version = 0, .key = "map.resolution", .value = "256"},
    {.version = 1, .key = "light.fit", .value = "scene"},
    {.version = 1, .key = "map.resolution", .value = "512"},
};

/// Scope in which the made-up defaults are those of earlier versions.
class TrialEarlierDefaults {
public:
    TrialEarlierDefaults() { std::swap(earlier_defaults(), rows_); }
    ~TrialEarlierDefaults() { std::swap(earlier_defaults(), rows_); }
    TrialEarlierDefaults(const TrialEarlierDefaults&) = delete;
    TrialEarlierDefaults& operator=(const TrialEarlierDefaults&) = delete;

private:
    std::span<const EarlierDefault> rows_ = kTrialRows;
};

std::string preset_of(int version, const std::string& settings) {
    return R"({"format":"shadow-inspector-preset","version":)" + std::to_string(version) + R"(,"settings":{)" +
           settings + "}}";
}

Settings read_preset(int version, const std::string& settings) {
    return parse_preset(preset_of(version, settings), "a.json").settings;
}

TEST(EarlierVersions, RowsAreDifferentSettings) {
    for (const EarlierDefault& row : earlier_defaults()) {
        ASSERT_TRUE(find_setting(row.key)) << row.key;
        EXPECT_LT(row.version, kSettingsVersion) << row.key;
        EXPECT_NO_THROW(parse_value(*find_setting(row.key), row.value)) << row.key;
    }
    EXPECT_EQ(defaults_of_version(kSettingsVersion), Settings());
}

TEST(EarlierVersions, Version2HasABiasByNumbers) {
    EXPECT_EQ(oldest_settings_version(), 2);
    EXPECT_EQ(readable_versions(), fmt::format("versions 2 to {}", kSettingsVersion));
    EXPECT_THROW(read_preset(1, ""), Error);
    const Settings now, old = read_preset(2, kDefaultBias), other = read_preset(2, kOtherBias);
    EXPECT_EQ(bias_of(now).key, "adaptive");
    EXPECT_EQ(now.bias.constant, 0);
    EXPECT_EQ(now.bias.normal, 0);
    EXPECT_EQ(old, slope_settings());
    EXPECT_EQ(old.bias.constant, 0.1);
    EXPECT_EQ(old.bias.normal, 3);
    EXPECT_EQ(other,
              settings_with({}, {"bias.kind=constant", "bias.constant=0.5", "bias.normal=3", "filter.kernel=hard"}));
    EXPECT_EQ(read_preset(kSettingsVersion, kDefaultBias), now);
}

TEST(EarlierVersions, SavingVersion2AgainKeepsAllValues) {
    for (const char* settings : {kDefaultBias, kOtherBias, R"("bias.kind":"adaptive","bias.normal":0)"}) {
        const Preset preset = parse_preset(preset_of(2, settings), "a.json");
        const std::string text = preset_text(preset);
        EXPECT_EQ(OrderedJson::parse(text)["version"], kSettingsVersion);
        EXPECT_EQ(parse_preset(text, "again").settings, preset.settings) << settings;
    }
}

TEST(EarlierVersions, EachHasItsOwnDefaults) {
    const TrialEarlierDefaults trial;
    EXPECT_EQ(oldest_settings_version(), 0);
    EXPECT_EQ(readable_versions(), fmt::format("versions 0 to {}", kSettingsVersion));
    EXPECT_EQ(defaults_of_version(0).map.resolution, 256) << "the oldest of two rows of a setting";
    EXPECT_EQ(defaults_of_version(1).map.resolution, 512);
    EXPECT_EQ(defaults_of_version(0).lights[3].fit, defaults_of_version(1).lights[3].fit);
    EXPECT_NE(defaults_of_version(1).lights[3].fit, Settings().lights[3].fit);
    EXPECT_EQ(defaults_of_version(kSettingsVersion), Settings());
    EXPECT_THROW(read_preset(-1, ""), Error);
}

TEST(EarlierVersions, FileChangesOnlyTheLightsThatItNames) {
    const TrialEarlierDefaults trial;
    const Settings s = read_preset(1, R"("light.count":2,"light.4.azimuth":7)");
    const Settings old = defaults_of_version(1);
    const Settings now;
    for (const int i : {0, 1, 2, 3, 4}) EXPECT_EQ(s.lights[std::size_t(i)].fit, old.lights[0].fit) << i;
    EXPECT_EQ(s.lights[5], now.lights[5]) << "a light that is added later has the present defaults";
    EXPECT_EQ(read_preset(kSettingsVersion, R"("light.count":2)").lights[0].fit, now.lights[0].fit);
    EXPECT_EQ(read_preset(1, R"("light.1.fit":"manual")").lights[1].fit, LightFit::Manual)
        << "a value of the file holds";
}

TEST(EarlierVersions, PresetSavedAgainHasTheSameMeaning) {
    const TrialEarlierDefaults trial;
    for (const int version : {0, 1, kSettingsVersion}) {
        const Preset preset = parse_preset(preset_of(version, R"("light.count":2,"bias.constant":3)"), "a.json");
        const std::string text = preset_text(preset);
        EXPECT_EQ(OrderedJson::parse(text)["version"], kSettingsVersion);
        EXPECT_EQ(OrderedJson::parse(text)["settings"].contains("map.resolution"), version < kSettingsVersion);
        EXPECT_EQ(parse_preset(text, "again").settings, preset.settings) << version;
    }
}

TEST(EarlierVersions, JournalIsReadWithTheDefaultsOfItsVersion) {
    const TrialEarlierDefaults trial;
    const auto base_of = [](int version, OrderedJson settings, OrderedJson axes) {
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
    const Settings one = base_of(1, {{"bias.constant", "0.5"}}, OrderedJson::array());
    EXPECT_EQ(one.bias.constant, 0.5);
    EXPECT_EQ(one.lights[0].fit, old);
    EXPECT_EQ(one.lights[1], now.lights[1]);
    const Settings varied = base_of(1, OrderedJson::object(), {{{"key", "light.count"}, {"values", {"1", "3"}}}});
    EXPECT_EQ(varied.lights[2].fit, old) << "some of the cases have three lights";
    EXPECT_EQ(varied.lights[3], now.lights[3]);
    EXPECT_EQ(base_of(kSettingsVersion, OrderedJson::object(), OrderedJson::array()), now);
    EXPECT_THROW(base_of(kSettingsVersion + 1, OrderedJson::object(), OrderedJson::array()), Error);
    EXPECT_THROW(base_of(-1, OrderedJson::object(), OrderedJson::array()), Error);
}

TEST(SizedKernels, SetSizeAndSamplingInEveryReader) {
    for (const SizedKernel& sized : sized_kernels()) {
        SCOPED_TRACE(sized.name);
        Settings set;
        set.filter.size = 12;
        set.filter.point = !sized.point.value_or(true);
        const bool point = set.filter.point;
        apply_set(set, fmt::format("filter.kernel={}", sized.name));
        EXPECT_EQ(set.filter.point, sized.point.value_or(point));
        const Settings read = read_preset(kSettingsVersion, fmt::format("\"filter.kernel\":\"{}\"", sized.name));
        const SweepAxis axis = parse_axis(fmt::format("filter.kernel=hard,{}", sized.name));
        EXPECT_EQ(axis.values, (std::vector<std::string>{"hard", std::string(sized.name)}));
        for (const Settings& s : {set, read, plan_sweep({}, {axis}).cases.at(1).settings}) {
            EXPECT_EQ(filter_of(s).key, sized.kernel);
            EXPECT_EQ(s.filter.size, sized.size);
        }
    }
    EXPECT_EQ(filter_of(Settings{}).key, "pcf");
    EXPECT_EQ(Settings{}.filter.size, 3);
}

TEST(SizedKernels, AreNoSecondValueOfASetting) {
    const auto read_size_twice = [] { read_preset(kSettingsVersion, R"("filter.kernel":"pcf5","filter.size":3)"); };
    EXPECT_TRUE(test::fails_with(read_size_twice, {"the same setting as \"filter.kernel\""}));
}

TEST(SizedKernels, AreNeitherChoicesNorProposed) {
    for (const SizedKernel& sized : sized_kernels())
        for (const Choice& choice : find_setting("filter.kernel")->param->choices()) EXPECT_NE(choice.key, sized.name);
    Settings s;
    const std::string text = test::error_text<UsageError>([&] { apply_set(s, "filter.kernel=pcf5_neares"); });
    EXPECT_FALSE(text.empty());
    EXPECT_EQ(text.find("pcf5_nearest"), std::string::npos) << text;
}

}  // namespace
}  // namespace si
