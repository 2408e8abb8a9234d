// Tests of the settings table: every member has a row, keys round-trip, values are read, refused and repaired.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "renderer/base/error.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/idle_reason.h"
#include "renderer/settings/param.h"
#include "renderer/settings/rows.h"
#include "renderer/settings/search.h"
#include "renderer/settings/sources.h"
#include "tests/support/error_text.h"
#include "tests/support/traits.h"

namespace si {
namespace {

std::string refusal(std::string_view key, std::string_view text) {
    Settings s;
    try {
        set_setting(s, key, text);
    } catch (const UsageError& e) {
        EXPECT_EQ(s, Settings{}) << "a refused value was written";
        return e.what();
    }
    return {};
}

bool mentions(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}

/// Returns a value in range that differs from the default.
Value other_value(const SettingRef& ref) {
    const Value v = default_value(ref);
    if (const bool* b = std::get_if<bool>(&v)) return !*b;
    if (const int* i = std::get_if<int>(&v)) return *i + 1 <= int(ref.param->max) ? *i + 1 : *i - 1;
    if (is_text(*ref.param)) return "Küche, \"a = 'b'\"";
    const double d = std::get<double>(v);
    if (d + 0.125 <= ref.param->max) return d + 0.125;
    return d - 0.125 >= ref.param->min ? d - 0.125 : 0.5 * (d + ref.param->max);
}

Settings every_setting_changed() {
    Settings s;
    s.objects["Root/Fence.001"] = {true, ObjectCull::None, true};
    for (const SettingRef& ref : all_settings(s)) set_value(s, ref, other_value(ref));
    return s;
}

TEST(SettingsTable, RowsAreCompleteAndDistinct) {
    std::set<std::string_view> keys;
    for (const Param& p : params()) {
        SCOPED_TRACE(p.key);
        EXPECT_TRUE(keys.insert(p.key).second);
        EXPECT_FALSE(p.label.empty());
        EXPECT_GT(p.help.size(), 10u);
        EXPECT_TRUE(p.help.ends_with(".")) << p.help;
        EXPECT_LT(p.min, p.max);
        if (p.choices) {
            for (const Choice& c : p.choices()) {
                EXPECT_FALSE(c.key.empty() || c.label.empty());
                EXPECT_EQ(c.key.find_first_of(" =\"."), std::string_view::npos);
            }
        }
        if (p.logarithmic) {
            EXPECT_FALSE(p.choices);
        }
    }
}

TEST(SettingsTable, EachRowHasItsOwnMember) {
    Settings s;
    ObjectSettings object;
    std::set<void*> members;
    for (const Param& p : params()) {
        const FieldRef field = p.field(s, 3, &object);
        const auto* choice = std::get_if<EnumRef>(&field);
        void* address = choice ? choice->address()
                               : std::visit(
                                     [](auto member) -> void* {
                                         if constexpr (std::is_pointer_v<decltype(member)>) return member;
                                         return nullptr;
                                     },
                                     field);
        EXPECT_TRUE(members.insert(address).second) << p.key;
    }
    EXPECT_EQ(members.size(), rows::member_count<CameraSettings>() + rows::member_count<MapSettings>() +
                                  rows::member_count<CasterSettings>() + rows::member_count<BiasSettings>() +
                                  rows::member_count<FilterSettings>() + rows::member_count<LightSettings>() +
                                  rows::member_count<ShadingSettings>() + rows::member_count<ViewSettings>() +
                                  rows::member_count<ObjectSettings>() + rows::member_count<ReferenceSettings>() +
                                  rows::member_count<SceneSettings>() + rows::member_count<VolumeSettings>() +
                                  rows::member_count<ContactSettings>() + rows::member_count<BlobSettings>() +
                                  rows::member_count<LightMapSettings>() + 1 /* light.count */);
}

TEST(SettingsTable, DefaultsAreInRangeAndNeedNoRepair) {
    Settings s;
    s.objects["A"] = {};
    for (const SettingRef& ref : all_settings(s)) {
        const Value v = default_value(ref);
        const double x = numeric_value(v);
        EXPECT_TRUE(x >= ref.param->min && x <= ref.param->max) << setting_key(ref);
    }
    EXPECT_TRUE(sanitise(s).empty());
}

TEST(SettingsTable, KeysAndValuesRoundTripAsText) {
    const Settings s = every_setting_changed();
    EXPECT_EQ(changed_settings(s).size(), all_settings(s).size());
    Settings copy;
    for (const SettingRef& ref : changed_settings(s)) {
        const std::string key = setting_key(ref);
        const auto found = find_setting(key);
        ASSERT_TRUE(found) << key;
        EXPECT_EQ(setting_key(*found), key);
        set_setting(copy, key, value_text(*ref.param, get_value(s, ref)));
    }
    EXPECT_EQ(copy, s);
}

TEST(SettingsTable, NumbersAreShortAndExact) {
    const auto ref = *find_setting("bias.slope");
    for (const double v : {0.1, 1e-7, 1.0 / 3.0, 1000.0, 123.456}) {
        EXPECT_EQ(std::get<double>(parse_value(ref, value_text(*ref.param, v))), v);
    }
    EXPECT_EQ(value_text(*ref.param, 0.1), "0.1");
    EXPECT_FALSE(std::signbit(std::get<double>(parse_value(*find_setting("light.azimuth"), "-0"))));
}

TEST(SettingsKeys, CoverLightsAndObjects) {
    EXPECT_EQ(find_setting("light.azimuth")->light, 0);
    EXPECT_EQ(find_setting("light.15.azimuth")->light, 15);
    EXPECT_EQ(setting_key(*find_setting("light.0.azimuth")), "light.azimuth");
    EXPECT_EQ(find_setting("light.count")->param->scope, Scope::Scene);
    const auto object = find_setting("object.Root/Leaves.v1.2.cull");
    ASSERT_TRUE(object);
    EXPECT_EQ(object->object, "Root/Leaves.v1.2");
    EXPECT_EQ(setting_key(*object), "object.Root/Leaves.v1.2.cull");
    for (const char* bad : {"", ".", "light", "light.", "light.16.azimuth", "light.-1.azimuth", "light.01.azimuth",
                            "light.1.", "light.1.count", "light..azimuth", "object.cull", "object..cull",
                            "object.A.colour", "bias", "bias.slope ", "Bias.slope", "light.99999999999.azimuth"}) {
        EXPECT_FALSE(find_setting(bad)) << bad;
    }
}

TEST(SettingsKeys, SuggestTheNearestKey) {
    EXPECT_EQ(nearest_key("bias.slop"), "bias.slope");
    EXPECT_EQ(nearest_key("bais.constant"), "bias.constant");
    EXPECT_EQ(nearest_key("light.3.azimut"), "light.3.azimuth");
    EXPECT_EQ(nearest_key("light.16.azimuth"), "light.15.azimuth");
    EXPECT_EQ(nearest_key("object.Root/Fence.cul"), "object.Root/Fence.cull");
    EXPECT_EQ(nearest_name("pcf4", {}), "");
    // A prefix suggests the first name with it; unlike words suggest nothing.
    EXPECT_EQ(nearest_key("filter"), "filter.kernel");
    EXPECT_EQ(nearest_key("fliter"), "filter.kernel");
    EXPECT_EQ(nearest_key("filter.kern"), "filter.kernel");
    EXPECT_EQ(nearest_key("kernel"), "filter.kernel");
    EXPECT_EQ(nearest_key("reslution"), "map.resolution");
    EXPECT_EQ(nearest_key("FILTER.KERNEL"), "filter.kernel");
    EXPECT_EQ(nearest_key("Light.3.Azimuth"), "light.3.azimuth");
    for (const char* unlike : {"", "x", "qqqq", "nowhere", "red.dwarf.star"})
        EXPECT_EQ(nearest_key(unlike), "") << unlike;
    EXPECT_EQ(nearest_key(std::string(1'000'000, 'b')), "") << "not compared letter by letter";
    const std::vector<std::string> names = {"hard", "pcf", "poisson"};
    EXPECT_EQ(nearest_name("pfc", names), "pcf");
    EXPECT_EQ(nearest_name("pois", names), "poisson");
    EXPECT_EQ(nearest_name("gauss", names), "");
    EXPECT_EQ(nearest_name("PCF", names), "pcf");
}

TEST(SettingsText, RefusesInvalidValues) {
    EXPECT_TRUE(mentions(refusal("bias.slop", "1"), "\"bias.slop\": unknown setting; did you mean bias.slope?"));
    EXPECT_TRUE(mentions(refusal("bias.slope", "nan"), "not finite"));
    EXPECT_TRUE(mentions(refusal("bias.slope", "inf"), "not finite"));
    EXPECT_TRUE(mentions(refusal("bias.slope", "-1"), "0 to 1000"));
    EXPECT_TRUE(mentions(refusal("bias.slope", "1,5"), "not a number"));
    EXPECT_TRUE(mentions(refusal("bias.slope", ""), "not a number"));
    EXPECT_TRUE(mentions(refusal("bias.slope", "1e999"), "bias.slope"));
    EXPECT_TRUE(mentions(refusal("map.resolution", "0"), "1 to 16384 texels"));
    EXPECT_TRUE(mentions(refusal("map.resolution", "99999999999"), "1 to 16384"));
    EXPECT_TRUE(mentions(refusal("map.resolution", "1024.5"), "whole number"));
    EXPECT_TRUE(mentions(refusal("map.reversed_z", "yes"), "true"));
    EXPECT_TRUE(mentions(refusal("map.format", "d23"), "did you mean d24?"));
    EXPECT_TRUE(mentions(refusal("map.format", "2"), "none of d16, d24, d32f, colour, linear, linear16"));
}

TEST(SettingsText, NamesArePrintableAndShort) {
    const auto ref = *find_setting("light.2.name");
    EXPECT_TRUE(is_text(*ref.param));
    EXPECT_FALSE(is_text(*find_setting("light.2.type")->param));
    const std::string longest(60, 'n');
    for (const std::string& name : {std::string(), std::string("key"), std::string("Küche 太陽 \"'=,"), longest})
        EXPECT_EQ(std::get<std::string>(parse_value(ref, name)), name);
    for (const std::string& name : {longest + "n", std::string("a\nb"), std::string("\x1b[2J"), std::string("\xff"),
                                    std::string("\u202eback"), std::string(1, '\0')}) {
        EXPECT_TRUE(test::fails_with<UsageError>([&] { parse_value(ref, name); }, {"light.2.name", "60 bytes"}))
            << name;
        Settings s;
        s.lights[2].name = name;
        s.lights[1].name = "kept";
        EXPECT_EQ(sanitise(s).size(), 1u);
        EXPECT_EQ(s.lights[2].name, "");
        EXPECT_EQ(s.lights[1].name, "kept");
    }
    Settings s;
    set_value(s, ref, 3.0);
    EXPECT_EQ(s, Settings()) << "a number is no name";
    set_value(s, *find_setting("light.2.azimuth"), "3");
    EXPECT_EQ(s, Settings()) << "and a text no number";
}

TEST(SettingsText, NumbersHaveNoExponentsAndTheUnitOfTheirKind) {
    Settings s;
    s.bias.unit = BiasUnit::Depth;
    const auto bias = *find_setting("bias.constant"), size = *find_setting("light.1.size");
    EXPECT_EQ(shown_value(s, bias, 5e-4), "0.0005 depth");
    EXPECT_EQ(shown_value(s, bias, 3.1329772020677598), "3.133 depth") << "sensible digits";
    EXPECT_EQ(shown_value(s, bias, 123456.7), "123457 depth") << "no exponent";
    EXPECT_EQ(shown_value(s, bias, 1e-7), "0.0000001 depth");
    s.bias.unit = BiasUnit::Texels;
    EXPECT_EQ(shown_value(s, bias, 0.3639), "0.3639 texels");
    EXPECT_EQ(shown_value(s, size, 4.0), "4°");
    s.lights[1].type = LightType::Spot;
    EXPECT_EQ(shown_value(s, size, 4.0), "4 m");
    EXPECT_EQ(shown_value(s, *find_setting("light.0.size"), 4.0), "4°") << "each light by itself";
}

TEST(SettingsText, LightsAreNamed) {
    Settings s;
    EXPECT_EQ(light_title(s, 1), "Light 1");
    s.lights[1].name = "key";
    EXPECT_EQ(light_title(s, 1), "Light 1 (key)");
    const auto ref = *find_setting("light.1.name");
    EXPECT_EQ(shown_value(s, ref, default_value(ref)), "none");
    EXPECT_EQ(change_text(Settings(), s, ref), "none → key");
}

TEST(SettingsText, AcceptsAllSpellingsOfBooleans) {
    Settings s;
    for (const char* on : {"true", "on", "1"}) {
        s.map.reversed_z = false;
        set_setting(s, "map.reversed_z", on);
        EXPECT_TRUE(s.map.reversed_z) << on;
    }
    for (const char* off : {"false", "off", "0"}) {
        s.map.reversed_z = true;
        set_setting(s, "map.reversed_z", off);
        EXPECT_FALSE(s.map.reversed_z) << off;
    }
}

TEST(SettingsObjects, OverrideEqualToTheDefaultsIsDropped) {
    Settings s;
    set_setting(s, "object.Floor.cull", "none");
    ASSERT_EQ(s.objects.count("Floor"), 1u);
    EXPECT_EQ(s.objects["Floor"].cull, ObjectCull::None);
    set_setting(s, "object.Floor.cull", "inherit");
    EXPECT_EQ(s, Settings{});
}

std::set<std::string> found_by(std::string_view words) {
    std::set<std::string> keys;
    for (const Param& p : params())
        if (setting_matches({&p, 0, p.scope == Scope::Object ? "Root/Box" : ""}, words)) keys.emplace(p.key);
    return keys;
}

TEST(SettingsSearch, TechniquesAreFoundByTheirNamesAmongChoices) {
    using Keys = std::set<std::string>;
    EXPECT_EQ(found_by("PCSS"), Keys{"filter.kernel"});
    EXPECT_EQ(found_by("lispsm"), Keys{"light.fit"});
    EXPECT_EQ(found_by("Vogel"), (Keys{"filter.kernel", "filter.disk"}));
    EXPECT_TRUE(found_by("vsm").contains("filter.kernel"));
    EXPECT_TRUE(found_by("poisson").contains("filter.kernel"));
    EXPECT_TRUE(found_by("pcf5").contains("filter.kernel")) << "a sized kernel";
    EXPECT_EQ(found_by("tent 3x3"), found_by("Tent 3×3"));
    EXPECT_TRUE(found_by("tent 3x3").contains("filter.kernel"));
    EXPECT_FALSE(found_by("normal bias").contains("view.overlay")) << "of two choices each holds one of the words";
    EXPECT_TRUE(found_by("pcf lispsm").empty()) << "two choices of two settings";
}

TEST(SettingsSearch, UnderscoresAndHyphensAreSpaces) {
    EXPECT_TRUE(found_by("shadow_normal_bias").contains("bias.normal"));
    EXPECT_EQ(found_by("shadow_normal_bias"), found_by("shadow normal bias"));
    EXPECT_TRUE(found_by("reversed-z").contains("map.reversed_z"));
    EXPECT_TRUE(found_by("raster slope").contains("bias.raster_slope"));
    EXPECT_EQ(found_by("map.reversed_z"), std::set<std::string>{"map.reversed_z"}) << "a whole key is that alone";
    EXPECT_EQ(found_by("").size(), params().size());
    EXPECT_TRUE(found_by("zzz").empty());
}

TEST(SettingsRepair, ReplacesNonFiniteAndOutOfRangeValues) {
    Settings s;
    s.bias.slope = std::numeric_limits<double>::quiet_NaN();
    s.lights[4].azimuth = std::numeric_limits<double>::infinity();
    s.camera.fov = 500;
    s.map.resolution = -3;
    s.map.format = MapFormat(77);
    const auto lines = sanitise(s);
    EXPECT_EQ(lines.size(), 5u);
    EXPECT_EQ(s.bias.slope, Settings{}.bias.slope);
    EXPECT_EQ(s.lights[4].azimuth, Settings{}.lights[4].azimuth);
    EXPECT_EQ(s.camera.fov, 170);
    EXPECT_EQ(s.map.resolution, 1);
    EXPECT_EQ(s.map.format, Settings{}.map.format);
    EXPECT_TRUE(sanitise(s).empty()) << "a repair needs no second one";
}

TEST(SettingsRepair, SwapsReversedPlanes) {
    Settings s;
    s.lights[2].near = 50;
    s.lights[2].far = 2;
    EXPECT_TRUE(sanitise(s).empty()) << "an automatic fit does not read near and far";
    s.lights[2].fit = LightFit::Manual;
    s.camera.source = CameraSource::Manual;
    s.camera.near = s.camera.far = 7;
    const auto lines = sanitise(s);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_TRUE(mentions(lines[0], "light.2.near")) << lines[0];
    EXPECT_EQ(s.lights[2].near, 2);
    EXPECT_EQ(s.lights[2].far, 50);
    EXPECT_LT(s.camera.near, s.camera.far);
    s.lights[2].near = 50;
    s.lights[2].far = 0;
    EXPECT_TRUE(sanitise(s).empty()) << "0 is automatic";
}

TEST(SettingsIdle, GivesReasons) {
    Settings s;
    const auto idle = [&](const char* key) { return idle_reason(s, *find_setting(key)); };
    EXPECT_FALSE(idle("light.near").empty());
    s.lights[0].fit = LightFit::Manual;
    EXPECT_TRUE(idle("light.near").empty());
    EXPECT_TRUE(idle("light.extent").empty());
    EXPECT_FALSE(idle("light.cone").empty());
    s.lights[0].type = LightType::Spot;
    EXPECT_TRUE(idle("light.cone").empty());
    EXPECT_TRUE(idle("light.extent").empty());
    s.lights[0].type = LightType::Point;
    EXPECT_FALSE(idle("light.extent").empty());
    EXPECT_FALSE(idle("light.1.azimuth").empty());
    s.light_count = 2;
    EXPECT_TRUE(idle("light.1.azimuth").empty());
    EXPECT_TRUE(idle("map.outside").empty());
    s.map.wrap = MapWrap::Repeat;
    EXPECT_TRUE(idle("map.outside").empty()) << "the far guard asks it";
    s.map.far_guard = false;
    EXPECT_TRUE(idle("map.outside").empty()) << "what lies behind the spot light asks it";
    s.lights[0].type = s.lights[1].type = LightType::Directional;
    EXPECT_FALSE(idle("map.outside").empty());
    EXPECT_FALSE(idle("camera.fov").empty());
    s.camera.source = CameraSource::Manual;
    EXPECT_TRUE(idle("camera.fov").empty());
}

TEST(SettingsIdle, LightMapsReadTheLightsSize) {
    Settings s;
    set_setting(s, "filter.kernel", "hard");
    set_setting(s, "light.source", "light-map");
    const auto idle = [&] { return idle_reason(s, *find_setting("light.size")); };
    s.truth.area = false;
    s.light_map.samples = 64;
    EXPECT_EQ(idle(), "");
    s.light_map.samples = 1;
    EXPECT_NE(idle(), "") << "the ray goes to the light's middle";
    s.light_map.samples = 64;
    s.lights[0].cast = false;
    EXPECT_NE(idle(), "");
}

TEST(SettingsIdle, TheShownMapMayBeAClipLevel) {
    Settings s;
    set_setting(s, "filter.kernel", "hard");
    s.lights[0].cascades = 1;
    const auto idle = [&] { return idle_reason(s, *find_setting("view.face")); };
    EXPECT_NE(idle(), "");
    s.map.paged = true;
    s.map.virtual_levels = 8;
    EXPECT_EQ(idle(), "");
    s.map.virtual_levels = 1;
    EXPECT_NE(idle(), "");
}

/// Returns a few possible values of a setting.
std::vector<Value> some_values(const SettingRef& ref) {
    const Param& p = *ref.param;
    const Value like = default_value(ref);
    if (std::holds_alternative<bool>(like)) return {false, true};
    if (is_text(p)) return {"", "key"};
    std::vector<Value> values;
    if (p.choices) {
        for (std::size_t i = 0; i < p.choices().size(); ++i) values.emplace_back(int(i));
        return values;
    }
    for (const double v : {p.min, p.min + 2, 0.5 * (p.min + p.max), p.max}) {
        if (std::holds_alternative<int>(like))
            values.emplace_back(int(v));
        else
            values.emplace_back(v);
    }
    return values;
}

SI_TEST_IS(Repeated, SettingsIdle, EveryReasonCanBeRemoved);
TEST(SettingsIdle, EveryReasonCanBeRemoved) {
    std::vector<std::pair<SettingRef, Value>> changes;
    for (const SettingRef& ref : all_settings(Settings{}))
        if (ref.light == 0)
            for (const Value& v : some_values(ref)) changes.emplace_back(ref, v);
    // Follows changes that lead to another reason.
    const std::function<bool(const SettingRef&, const Settings&, int)> ends_one_by_one =
        [&](const SettingRef& ref, const Settings& from, int most) {
            if (idle_reason(from, ref).empty() || most == 0) return idle_reason(from, ref).empty();
            return std::ranges::any_of(changes, [&](const auto& change) {
                Settings once = from;
                set_value(once, change.first, change.second);
                return idle_reason(once, ref) != idle_reason(from, ref) && ends_one_by_one(ref, once, most - 1);
            });
        };
    const auto ends = [&](const SettingRef& ref) {
        Settings once;
        for (const auto& [a, value] : changes) {
            once = {};
            set_value(once, a, value);
            if (idle_reason(once, ref).empty()) return true;
        }
        for (const auto& [a, first] : changes)
            for (const auto& [b, second] : changes) {
                once = {};
                set_value(once, a, first);
                set_value(once, b, second);
                if (idle_reason(once, ref).empty()) return true;
            }
        return ends_one_by_one(ref, {}, 3);
    };
    for (const SettingRef& ref : all_settings(Settings{}))
        if (ref.light == 0 && !idle_reason(Settings{}, ref).empty()) {
            EXPECT_TRUE(ends(ref)) << setting_key(ref) << " is always " << idle_reason(Settings{}, ref);
        }
}

TEST(SettingsOwned, ActIfAnyLightHasTheirSource) {
    std::size_t owned = 0;
    for (const Source& source : sources())
        for (const std::string_view key : source.settings) {
            const SettingRef ref = *find_setting(key);
            Settings s;
            EXPECT_NE(unused_setting_reason(s, ref), "") << key << " under a map";
            set_setting(s, "light.1.source", source.key);
            EXPECT_NE(unused_setting_reason(s, ref), "") << key << ": the second light is not there";
            s.light_count = 2;
            EXPECT_EQ(idle_reason(s, ref), "") << key;
            ++owned;
        }
    EXPECT_GE(owned, 7u);
}

TEST(SettingsOwned, ActOnlyForKernelsThatListThem) {
    int owned = 0;
    for (const SettingRef& ref : all_settings(Settings{})) {
        if (ref.light != 0 || !ref.param->key.starts_with("filter.")) continue;
        Settings s;
        std::size_t readers = 0;
        for (std::size_t row = 0; row < filters().size(); ++row) {
            s.filter.kernel = int(row);
            const auto own = filters()[row].settings;
            const bool lists = std::ranges::find(own, ref.param->key) != own.end();
            readers += lists;
            if (lists) {
                EXPECT_EQ(unused_setting_reason(s, ref), "") << ref.param->key << " under " << filters()[row].key;
            }
        }
        if (readers == 0) {
            EXPECT_EQ(unused_setting_reason(Settings{}, ref), "") << ref.param->key << " belongs to no kernel";
            continue;
        }
        ++owned;
        Settings hard;
        set_setting(hard, "filter.kernel", "hard");
        EXPECT_NE(unused_setting_reason(hard, ref), "") << "the hard kernel has no settings of its own";
        EXPECT_EQ(idle_reason(hard, ref), unused_setting_reason(hard, ref));
        EXPECT_TRUE(mentions(std::string(idle_reason(hard, ref)), "filter.kernel"));
    }
    EXPECT_GE(owned, 8);
}

}  // namespace
}  // namespace si
