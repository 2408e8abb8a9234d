// Tests of differences in words: complete, without additions, with correct units and headings.
#include "app/session/preset_diff.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/sets.h"

namespace si {
namespace {

Preset preset_with(const Sets& settings, const std::string& scene = {}) {
    Preset p;
    p.scene = scene;
    p.settings = settings_with({}, settings);
    return p;
}

std::string line(const Preset& a, const Preset& b, const std::string& key) {
    for (const PresetDifference& d : preset_differences(a, b))
        if (d.key == key) return d.group + " | " + d.text;
    return {};
}

TEST(PresetDiff, EqualPresetsHaveNoDifferences) {
    const Preset p = preset_with({"bias.constant=0.3", {"object.Root/Box.cull", "front"}}, "boxes");
    EXPECT_TRUE(preset_differences(p, p).empty());
    EXPECT_EQ(differences_text({}, "a.json", "b.json"), "a.json and b.json are equal\n");
    Preset told = p;
    told.about = "words alone make no difference";
    EXPECT_TRUE(preset_differences(p, told).empty());
}

TEST(PresetDiff, NamesKeyValuesUnitAndLabel) {
    const Preset a = preset_with({}), b = preset_with({"bias.constant=0.1"});
    EXPECT_EQ(line(a, b, "bias.constant"), "Bias | bias.constant: 0 → 0.1 texels (Constant bias)");
    EXPECT_EQ(line(b, a, "bias.constant"), "Bias | bias.constant: 0.1 → 0 texels (Constant bias)");
}

TEST(PresetDiff, NamesBothUnitsWhereTheyDiffer) {
    const Preset a = preset_with({}), b = preset_with({"bias.unit=depth", "bias.constant=0.005"});
    EXPECT_EQ(line(a, b, "bias.constant"), "Bias | bias.constant: 0 texels → 0.005 depth (Constant bias)");
    EXPECT_EQ(line(a, b, "bias.unit"), "Bias | bias.unit: texels → depth (Unit)");
}

TEST(PresetDiff, NamesALightByItsLabel) {
    const Preset a = preset_with({"light.count=2", "light.1.name=key"});
    Preset b = a;
    set_setting(b.settings, "light.1.azimuth", "90");
    EXPECT_EQ(line(a, b, "light.1.azimuth"), "Light 1 (key) | light.1.azimuth: -40° → 90° (Azimuth)");
}

TEST(PresetDiff, DescribesChoicesSwitchesAnglesLightsObjectsAndScenes) {
    const Preset a = preset_with({}, "boxes");
    const Preset b = preset_with({"caster.cull=front",
                                  "map.far_guard=false",
                                  "light.count=2",
                                  "light.1.azimuth=90",
                                  {"object.Root/Box.v1.cast", "false"}},
                                 "stage");
    EXPECT_EQ(line(a, b, "scene"), "Scene | scene: boxes → stage");
    EXPECT_EQ(line(a, b, "caster.cull"), "Casters | caster.cull: none → front faces (Cull casters)");
    EXPECT_EQ(line(a, b, "map.far_guard"), "Shadow map | map.far_guard: on → off (Far-plane test)");
    EXPECT_EQ(line(a, b, "light.count"), "Lights | light.count: 1 → 2 (Lights)");
    EXPECT_EQ(line(a, b, "light.1.azimuth"), "Light 1 | light.1.azimuth: -40° → 90° (Azimuth)");
    EXPECT_EQ(line(a, b, "object.Root/Box.v1.cast"), "Object Root/Box.v1 | object.Root/Box.v1.cast: on → off (Casts)");
    EXPECT_EQ(line(b, a, "object.Root/Box.v1.cast"), "Object Root/Box.v1 | object.Root/Box.v1.cast: off → on (Casts)");
    EXPECT_EQ(line(preset_with({}), b, "scene"), "Scene | scene: any → stage");
}

TEST(PresetDiff, FindsExactlyTheChangedSettings) {
    // Each setting alone, of every type.
    for (const Param& p : params()) {
        const SettingRef ref{&p, p.scope == Scope::Light ? 3 : 0, p.scope == Scope::Object ? "Root/Box" : ""};
        const Preset a;
        Preset b;
        const Value v = default_value(ref);
        if (const bool* on = std::get_if<bool>(&v))
            set_value(b.settings, ref, !*on);
        else if (p.choices)
            set_value(b.settings, ref, std::get<int>(v) == 0 ? 1 : 0);
        else if (is_text(p))
            set_value(b.settings, ref, "key");
        else if (std::holds_alternative<int>(v))
            set_value(b.settings, ref, int(p.min) == std::get<int>(v) ? int(p.max) : int(p.min));
        else
            set_value(b.settings, ref, p.min == std::get<double>(v) ? p.max : p.min);
        const auto found = preset_differences(a, b);
        ASSERT_EQ(found.size(), 1u) << setting_key(ref);
        EXPECT_EQ(found[0].key, setting_key(ref));
        EXPECT_NE(found[0].text.find("→"), std::string::npos);
        // The two sides of the arrow must differ.
        const std::string change = change_text(a.settings, b.settings, ref);
        const auto arrow = change.find(" → ");
        EXPECT_NE(change.substr(0, arrow), change.substr(arrow + 5)) << setting_key(ref) << ": " << change;
    }
}

TEST(PresetDiff, MarksSettingsThatAreIdleInBoth) {
    const auto found = preset_differences(preset_with({}), preset_with({"light.5.cone=20"}));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].note, "without effect: the light is off");
    const auto lit = preset_differences(preset_with({}), preset_with({"light.type=spot", "light.cone=20"}));
    ASSERT_EQ(lit.size(), 2u);
    for (const PresetDifference& d : lit) EXPECT_EQ(d.note, "") << d.key;
}

TEST(PresetDiff, TextIsGroupedUnderHeadings) {
    const Preset a, b = preset_with({"bias.raster_slope=2", "bias.normal=3", "map.resolution=64"});
    EXPECT_EQ(differences_text(preset_differences(a, b), "default", "b"),
              "default → b: 3 differences\n"
              "Shadow map\n  map.resolution: 2048 → 64 texels (Resolution)\n"
              "Bias\n  bias.normal: 0 → 3 texels (Normal offset)\n"
              "  bias.raster_slope: 0 → 2 x depth slope (Polygon offset factor)\n");
}

}  // namespace
}  // namespace si
