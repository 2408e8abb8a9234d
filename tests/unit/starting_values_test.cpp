// Tests of starting values: settings that a person's choice of bias.kind brings along, and what assigns plainly.
#include "renderer/settings/starting_values.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/session/command_line.h"
#include "app/session/session.h"
#include "app/sweep/spec.h"
#include "renderer/measure/axes.h"
#include "renderer/scenes/builtin.h"
#include "tests/support/sets.h"

namespace si {
namespace {

using Texts = std::vector<std::string>;

Settings with_sets(Settings settings, const Texts& sets) {
    apply_sets(settings, sets);
    return settings;
}

/// Returns the specification of a sweep over default settings.
SweepSpec spec_of(std::vector<SweepAxis> axes, const Settings& base = {}) {
    return {.scene = "boxes",
            .scene_content = 1,
            .triangles = 12,
            .base = base,
            .axes = std::move(axes),
            .width = 64,
            .height = 36,
            .area = false,
            .shard = {}};
}

Settings first_case(const SweepSpec& spec) {
    return plan_sweep(spec.base, spec.axes).cases.at(0).settings;
}

TEST(StartingValues, EachKindHasThem) {
    const SettingRef kind = *find_setting("bias.kind");
    for (const Bias& row : biases()) {
        EXPECT_EQ(row.starts.empty(), row.stage != BiasStage::Compare) << row.key;
        for (const auto& [key, value] : row.starts) {
            ASSERT_TRUE(find_setting(key)) << key;
            EXPECT_NO_THROW(parse_value(*find_setting(key), value)) << row.key << " " << key;
            EXPECT_TRUE(keys_with_starting_values(kind).contains(std::string(key))) << key;
        }
    }
    Settings started;
    set_starting_values(slope_settings(), started);
    EXPECT_EQ(started, Settings()) << "the default kind starts with the defaults";
    EXPECT_TRUE(keys_with_starting_values(*find_setting("filter.kernel")).empty());
}

TEST(StartingValues, HelpNamesThem) {
    const std::string_view help = find_setting("bias.kind")->param->help;
    for (const Bias& row : biases()) {
        if (row.stage != BiasStage::Compare) continue;
        const Settings s = with_sets(slope_settings(), {fmt::format("bias.kind={}", row.key)});
        EXPECT_EQ(s.bias.constant, row.gives_needed_bias ? 0 : 0.1) << row.key;
        EXPECT_EQ(s.bias.normal, row.gives_needed_bias ? 0 : 3) << row.key;
    }
    EXPECT_NE(help.find("0.1 and 3 texels for slope and constant, 0 and 0 for all other kinds"), help.npos) << help;
}

TEST(StartingValues, ComeWithAnotherKindOnACommandLine) {
    EXPECT_EQ(with_sets({}, {"bias.kind=slope"}), slope_settings());
    EXPECT_EQ(with_sets(slope_settings(), {"bias.kind=adaptive"}), Settings());
    EXPECT_EQ(with_sets({}, {"bias.kind=slope", "bias.kind=adaptive"}), Settings()) << "the last one wins";
    const Settings depth = settings_with({}, {"bias.unit=depth", "bias.constant=0.005"});
    EXPECT_EQ(with_sets(depth, {"bias.kind=constant"}).bias.unit, BiasUnit::Texels) << "0.1 of depth would be much";
    const Settings metres = settings_with({}, {"bias.normal=0.02", "bias.normal_unit=metres", "bias.normal_by=sine"});
    EXPECT_EQ(with_sets(metres, {"bias.kind=constant"}).bias.normal_unit, OffsetUnit::Texels) << "3 m would be much";
    EXPECT_EQ(with_sets(metres, {"bias.kind=constant"}).bias.normal_by, OffsetBy::Sine) << "it is no amount";
    const Settings own = settings_with(slope_settings(), {"bias.normal=1"});
    EXPECT_EQ(with_sets(own, {"bias.kind=slope"}), own) << "it is no other kind";
}

TEST(StartingValues, YieldToTheSameCommandLineInAnyOrder) {
    for (const Texts& sets : {Texts{"bias.kind=slope", "bias.normal=0"}, Texts{"bias.normal=0", "bias.kind=slope"}}) {
        const Settings s = with_sets({}, sets);
        EXPECT_EQ(s.bias.normal, 0);
        EXPECT_EQ(s.bias.constant, 0.1);
    }
}

TEST(StartingValues, DoNotComeWithPlainAssignments) {
    const Settings kind_alone = settings_with({}, {"bias.kind=slope"});
    EXPECT_EQ(kind_alone.bias.normal, 0);
    Settings s;
    apply_set(s, "bias.kind=slope");
    EXPECT_EQ(s, kind_alone);
    constexpr std::string_view kPreset =
        R"({"format":"shadow-inspector-preset","version":3,"settings":{"bias.kind":"slope"}})";
    EXPECT_EQ(parse_preset(kPreset, "a.json").settings, kind_alone);
}

TEST(StartingValues, CommandLinesOfSettingsNameThemWhereTheyDiffer) {
    const Scene scene = load_scene("boxes");
    for (const Settings& settings : {settings_with(base_settings(scene), {"bias.kind=slope"}),
                                     slope_settings(base_settings(scene)), base_settings(scene)}) {
        const SessionPlan plan = session_plan("boxes", scene, settings);
        EXPECT_EQ(compose_settings(plan, scene, settings.scene).settings, settings);
    }
    EXPECT_EQ(settings_to_set({}, slope_settings()).size(), 3u) << "kind, constant, normal";
    EXPECT_EQ(settings_to_set({}, settings_with({}, {"bias.kind=slope"})).size(), 3u);
    EXPECT_EQ(settings_to_set(slope_settings(), {}).size(), 3u);
    EXPECT_EQ(settings_to_set(slope_settings(), settings_with(slope_settings(), {"bias.normal=1"})).size(), 1u);
}

TEST(StartingValues, ComeWithTheKindsOfASweep) {
    const SweepPlan plan = plan_sweep({}, {parse_axis("bias.kind=adaptive,slope"), parse_axis("map.resolution=512")});
    ASSERT_EQ(plan.cases.size(), 2u);
    EXPECT_TRUE(plan.cases[0].starts.empty());
    EXPECT_EQ(plan.cases[1].settings, settings_with(slope_settings(), {"map.resolution=512"}));
    EXPECT_EQ(plan.cases[1].id, "bias.kind=slope map.resolution=512");
    Settings set;
    for (const auto& [key, value] : plan.cases[1].sets()) set_setting(set, key, value);
    EXPECT_EQ(set, plan.cases[1].settings);
    const SweepPlan varied = plan_sweep({}, {parse_axis("bias.normal=0,1"), parse_axis("bias.kind=slope")});
    EXPECT_EQ(varied.cases.at(0).settings.bias.normal, 0) << "an axis of its own";
    EXPECT_EQ(varied.cases.at(0).settings.bias.constant, 0.1);
}

TEST(StartingValues, YieldToTheSetsOfASweep) {
    std::vector<SweepAxis> axes = {parse_axis("bias.kind=slope"), parse_axis("map.resolution=512")};
    protect_assigned_settings(axes, assigned_keys(Texts{"bias.normal=0", "map.format=d16"}));
    EXPECT_EQ(axes[0].held, (std::set<std::string>{"bias.normal"}));
    EXPECT_TRUE(axes[1].held.empty());
    const SweepSpec spec = spec_of(axes), again = spec_from_json(spec_json(spec));
    EXPECT_EQ(spec_json(again), spec_json(spec));
    for (const Settings& s : {first_case(spec), first_case(again)}) {
        EXPECT_EQ(s.bias.normal, 0);
        EXPECT_EQ(s.bias.constant, 0.1);
    }
    axes[0].held.clear();
    EXPECT_NE(spec_difference(spec_json(spec), spec_json(spec_of(axes))), "");
}

TEST(StartingValues, DoNotComeWithTheKindsOfASweepOfVersion2) {
    const auto json = spec_json(spec_of({parse_axis("bias.kind=adaptive")}));
    const SweepSpec old = spec_from_json(json, 2);
    EXPECT_EQ(old.base, slope_settings());
    EXPECT_EQ(first_case(old), settings_with(slope_settings(), {"bias.kind=adaptive"}));
    EXPECT_EQ(first_case(spec_from_json(spec_json(old))), first_case(old));
}

}  // namespace
}  // namespace si
