// Tests of engine profiles: the worked example of every engine, round trips, hidden bias, hostile values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "renderer/base/error.h"
#include "renderer/profiles/bias_numbers.h"
#include "renderer/profiles/engine_profile.h"
#include "renderer/profiles/engine_wording.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

/// Returns settings with a constant bias and a normal offset in texels, and a kernel by its --set text.
Settings profile_settings(double constant, double normal, std::string_view kernel) {
    Settings s;
    set_setting(s, "bias.kind", "constant");
    set_setting(s, "filter.kernel", kernel);
    s.bias.constant = constant;
    s.bias.normal = normal;
    return s;
}

/// Number of the worked example: W 20 m, N 2048, D 40 m, constant 1.5 texels, normal offset 1 texel, 45 degrees.
struct WorkedNumber {
    const char* profile;
    const char* kernel;
    double normal;  ///< texels: 1, or 0 for a constant alone
    const char* key;
    double value, literal;
};

constexpr double kWorkedTolerance = 0.005;

constexpr WorkedNumber kWorked[] = {
    {"three", "vogel", 1, "bias", -0.000366211, -0.000366211},
    {"three", "vogel", 1, "normalBias", 0.00976563, 0.00976563},
    {"three", "vogel", 1, "mapSize", 2048, 2048},
    {"three", "vogel", 1, "shadow.camera.right", 10, 10},
    {"babylon", "hard", 1, "bias", 0.000366211, 0.000366211},
    {"babylon", "tent5", 1, "bias", 0.000732422, 0.000732422},
    {"babylon", "pcss", 1, "bias", 0.000732422, 0.000732422},
    {"babylon", "hard", 1, "normalBias", 0.0138107, 0.0138107},
    {"babylon", "hard", 1, "shadowFrustumSize", 20, 20},
    {"playcanvas", "tent5", 1, "shadowBias", 0.10904, 0.15},
    {"playcanvas", "tent5", 1, "normalOffsetBias", 0.00976563, 0.00976563},
    {"godot", "soft-low", 1, "shadow_bias", 0.026952, 0.0183105},
    {"godot", "soft-low", 0, "shadow_bias", 0.0183105, 0.0183105},
    {"godot", "hw2x2", 0, "shadow_bias", 0.0366211, 0.0366211},
    {"godot", "hw2x2", 1, "shadow_bias", 0.053884, 0.0366211},
    {"godot", "soft-low", 1, "shadow_normal_bias", 1, 1},
    {"urp", "tent5", 1, "shadowDepthBias", 0.165685, 0.6},
    {"urp", "tent5", 1, "shadowNormalBias", 0, 1.36569},
    {"urp", "hw2x2", 1, "shadowDepthBias", 0.414214, 1.5},
    {"urp", "hw2x2", 1, "shadowNormalBias", 0, 3.41421},
    {"urp-slope", "tent5", 1, "shadowDepthBias", 0.233137, 0.12},
    {"hdrp", "tent5", 1, "normalBias", 0.707107, 0.707107},
    {"hdrp", "tent5", 1, "slopeBias", 0.2875, 0.3},
    {"unreal", "tent5", 0, "ShadowBias", 0.3, 0.3},
    {"unreal", "tent5", 1, "ShadowBias", 0.582843, 0.3},
    {"unreal", "tent5", 1, "ShadowSlopeBias", 0, 0},
    {"unreal", "tent5", 1, "r.Shadow.Virtual.NormalBias", 0.976563, 0.976563},
    {"filament", "tent5", 1, "constantBias", 0.0146628, 0.0146628},
    {"filament", "tent5", 1, "normalBias", 2.82843, 2.82843},
    {"filament", "tent5", 1, "polygonOffsetSlope", 0, 0},
    {"filament", "tent5", 1, "polygonOffsetConstant", 0, 0},
    {"filament19", "tent3", 1, "constantBias", 0.0187115, 0.0146628},
    {"filament19", "tent3", 0, "constantBias", 0.0048876, 0.0146628},
    {"godot3", "hw2x2", 0, "shadow_bias", 0.0146484, 0.0146484},
    {"godot3", "hw2x2", 1, "shadow_bias", 0.0284591, 0.0146484},
    {"godot3", "hw2x2", 1, "directional_shadow_normal_bias", 0, 0.0471517},
    {"ogre", "pcf2", 0, "depth_bias.constant", -6144, 0},
    {"bevy", "gauss5", 1, "shadow_depth_bias", 0.0146484, 0.0146484},
    {"bevy", "gauss5", 1, "shadow_normal_bias", 0.707107, 0.707107},
    {"o3de", "tent5", 1, "ShadowBias", 0, 0.0146484},
    {"o3de", "tent5", 1, "NormalShadowBias", 0, 10},
};

TEST(EngineProfiles, GiveTheWorkedExample) {
    for (const WorkedNumber& row : kWorked) {
        const bool soft_low = std::string_view(row.kernel) == "soft-low";
        Settings s = profile_settings(1.5, row.normal, soft_low ? "vogel" : row.kernel);
        if (soft_low) s.filter.taps = 4;
        const WrittenValues written = write_engine_values(engine_profile(row.profile), s, {});
        const ConvertedParameter* p = written.find(row.key);
        ASSERT_TRUE(p) << row.profile << " " << row.key;
        EXPECT_NEAR(p->value, row.value, kWorkedTolerance * std::abs(row.value))
            << row.profile << " " << row.kernel << " " << row.key;
        EXPECT_NEAR(p->literal, row.literal, kWorkedTolerance * std::abs(row.literal))
            << row.profile << " " << row.kernel << " " << row.key;
        EXPECT_NEAR(written.wanted_texels, 1.5 + row.normal * std::numbers::sqrt2, 1e-6);
    }
}

TEST(EngineProfiles, GiveTheWorkedExampleUnderOtherParameters) {
    const Settings s = profile_settings(1.5, 1, "tent5");
    const EngineProfile& babylon = engine_profile("babylon");
    EXPECT_NEAR(write_engine_values(babylon, s, {.cascades = 4}).find("bias")->value, 0.000244141, 1e-6);
    const EngineProfile& unreal = engine_profile("unreal");
    EXPECT_NEAR(write_engine_values(unreal, s, {}, {{"ShadowSlopeBias", 0.5}}).find("ShadowBias")->value, 0.233137,
                1e-4);
    EXPECT_NEAR(write_engine_values(unreal, s, {}, {{"r.Shadow.CSMDepthBias", 20}}).find("ShadowBias")->value, 0.291421,
                1e-4);
    EXPECT_EQ(
        write_engine_values(engine_profile("urp"), s, {.cascades = 4}).find("mainLightShadowmapResolution")->value,
        4096)
        << "cascades share the map";
}

TEST(EngineProfiles, GiveUnitsOfGraphicsApis) {
    Settings s = profile_settings(1.5, 1, "tent5");
    const auto number = [&](const char* profile, const char* key) {
        const WrittenValues written = write_engine_values(engine_profile(profile), s, {});
        return *written.find(key);
    };
    s.map.format = MapFormat::D24;
    EXPECT_EQ(number("opengl", "units").value, 6144);
    EXPECT_EQ(number("vulkan", "depthBiasConstantFactor").value, 6144);
    EXPECT_EQ(number("d3d12", "DepthBias").value, 6144);
    EXPECT_EQ(number("webgpu", "depthBias").value, 6144);
    EXPECT_NEAR(number("opengl", "factor").literal, 1.5, 1e-9) << "the slope that gives the constant at 45 degrees";
    EXPECT_NEAR(number("opengl", "shader.normalOffset").value, 0.009765625, 1e-12);
    s.map.format = MapFormat::D16;
    EXPECT_EQ(number("opengl", "units").value, 24);
    s.map.format = MapFormat::D32F;
    EXPECT_EQ(number("opengl", "units").value, 0) << "no fixed number of units";
    EXPECT_NEAR(number("opengl", "shader.depthBias").value, 0.000366211, 1e-9);
    s.bias.raster_slope = 2;
    s.map.reversed_z = true;
    EXPECT_EQ(number("d3d12", "SlopeScaledDepthBias").value, -2) << "reversed depth negates";
    s.bias.raster_units = 0.4;
    EXPECT_EQ(number("d3d12", "DepthBias").value, 0) << "integers";
    EXPECT_FALSE(number("d3d12", "DepthBias").note.empty());
}

TEST(EngineProfiles, NameTheirHiddenBias) {
    const auto hidden = [](const char* name) {
        const EngineProfile& profile = engine_profile(name);
        return profile.hidden_texels ? profile.hidden_texels(profile, {}, {}) : 0;
    };
    for (const char* name : {"three", "godot", "urp-slope", "unreal", "babylon", "bevy", "opengl", "godot3", "ogre"})
        EXPECT_EQ(hidden(name), 0) << name;
    const double unit_texels = std::ldexp(40.0, -24) / (20.0 / 2048);
    EXPECT_NEAR(hidden("urp"), 2.5 + unit_texels, 1e-9);
    EXPECT_NEAR(hidden("filament"), 2.0, 1e-9);
    EXPECT_NEAR(hidden("filament19"), 3.0, 1e-9) << "and a normal offset of a texel";
    EXPECT_NEAR(hidden("hdrp"), 0.0625 + unit_texels, 1e-9);
    EXPECT_NEAR(hidden("playcanvas"), 0.4096, 1e-9);
    EXPECT_NEAR(hidden("o3de"), 4 + 10 * unit_texels, 1e-9);
}

/// Returns true when a number of written values is not the one that the bias asks for.
bool is_clamped(const WrittenValues& written) {
    return std::ranges::any_of(written.parameters, [](const ConvertedParameter& p) {
        return p.note.find("outside of the engine's range") != std::string::npos ||
               p.note.find("rounded") != std::string::npos;
    });
}

// The sum of what is written and hidden is what was asked for, unless a number would be below 0.
TEST(EngineProfiles, GiveAnEqualBiasAtTheReferenceAngle) {
    for (const EngineProfile& profile : engine_profiles()) {
        if (!profile.write_bias) continue;
        for (const double angle : {10.0, 45.0, 70.0})
            for (const double constant : {0.0, 1.5, 8.0})
                for (const double normal : {0.0, 1.0, 2.0}) {
                    Settings s = profile_settings(constant, normal, "tent5");
                    s.map.format = MapFormat::D24;
                    const MapFacts facts{.angle_deg = angle};
                    const WrittenValues written = write_engine_values(profile, s, facts);
                    if (is_clamped(written)) continue;
                    // Only the lengths of engines that have a normal offset of their own cannot shrink.
                    const double own_normal = profile.name == "playcanvas" || profile.name == "hdrp"
                                                  ? normal * offset_equivalent(OffsetBy::Length, angle)
                                                  : 0;
                    EXPECT_NEAR(written.given_texels,
                                std::max(written.wanted_texels, written.hidden_texels + own_normal), 1e-6)
                        << profile.name << " at " << angle << ", constant " << constant << ", normal " << normal;
                }
    }
}

/// Returns settings after reading engine values into the defaults.
Settings read_into_settings(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    Settings s;
    for (const ConvertedSetting& setting : read_engine_values(profile, values, facts))
        set_setting(s, setting.key, setting.value);
    return s;
}

// A normal offset by the engine's own rule is the same number again, at any reference angle.
TEST(EngineProfiles, KeepTheirOwnNormalOffset) {
    for (const char* name : {"urp", "urp-slope"})
        for (const double angle : {0.0, 20.0, 45.0, 80.0}) {
            const EngineProfile& profile = engine_profile(name);
            const MapFacts facts{.angle_deg = angle, .format = MapFormat::D24};
            Settings s = read_into_settings(profile, {{"shadowDepthBias", 0.75}, {"shadowNormalBias", 2}}, facts);
            s.map.format = MapFormat::D24;
            const WrittenValues written = write_engine_values(profile, s, facts);
            EXPECT_NEAR(written.find("shadowNormalBias")->value, 2, 1e-9) << name << " at " << angle;
            EXPECT_EQ(written.find("shadowNormalBias")->exactness, Exactness::Exact) << name << " at " << angle;
            if (angle > 0) {
                EXPECT_NEAR(written.find("shadowDepthBias")->value, 0.75, 1e-6) << name << " at " << angle;
            }
        }
}

TEST(EngineProfiles, ReadWhatTheyWrote) {
    for (const char* name : {"three", "bevy", "opengl", "vulkan", "filament", "babylon", "godot", "urp", "urp-slope",
                             "hdrp", "playcanvas", "o3de", "ogre", "unreal", "filament19", "godot3"}) {
        const EngineProfile& profile = engine_profile(name);
        for (const double angle : {20.0, 45.0}) {
            const MapFacts facts{
                .width_m = 33, .texels = 1024, .depth_m = 71, .angle_deg = angle, .format = MapFormat::D24};
            Settings s = profile_settings(6.25, 0.5, "tent5");
            s.map.format = MapFormat::D24;
            const WrittenValues written = write_engine_values(profile, s, facts);
            if (is_clamped(written)) continue;
            const Settings read = read_into_settings(profile, written.values(), facts);
            const BiasNumbers before = bias_numbers(s, facts);
            Settings same_format = read;
            same_format.map.format = s.map.format;
            const BiasNumbers after = bias_numbers(same_format, facts);
            EXPECT_NEAR(after.total_texels(facts), before.total_texels(facts), 1e-9) << name << " at " << angle;
            for (const ConvertedParameter& p : written.parameters)
                if (p.parameter->setting == "bias.normal" && p.exactness == Exactness::Exact) {
                    EXPECT_NEAR(after.normal_texels, before.normal_texels, 1e-9) << name;
                }
            // Settings as the profile draws them give the same numbers again.
            const WrittenValues again = write_engine_values(profile, same_format, facts);
            for (const ConvertedParameter& p : written.parameters) {
                if (!p.parameter->is_bias || p.parameter->key.starts_with("r.Shadow.Virtual")) continue;
                EXPECT_NEAR(again.find(p.parameter->key)->value, p.value, 1e-5 * std::abs(p.value) + 1e-9)
                    << name << " " << p.parameter->key << " at " << angle;
            }
        }
    }
}

// A second computation: the number of each engine as metres along the light, from the engine's own formula.
TEST(EngineProfiles, ReadEnginesOwnNumbers) {
    const MapFacts facts{.width_m = 20, .texels = 2048, .depth_m = 40, .angle_deg = 60};
    const double t = 20.0 / 2048, tangent = std::tan(std::numbers::pi / 3);
    const auto metres = [&](const char* name, const EngineValues& values) {
        return bias_numbers(read_into_settings(engine_profile(name), values, facts), facts).total_texels(facts) * t;
    };
    const double unit_m = 40 * std::ldexp(1.0, -24);
    EXPECT_NEAR(metres("three", {{"bias", -0.0005}, {"normalBias", 0.02}}), 0.0005 * 40 + 0.02 / 0.5, 1e-9);
    EXPECT_NEAR(metres("urp", {{"shadowDepthBias", 1}, {"shadowNormalBias", 1}, {"softShadowQuality", 2}}),
                2.5 * t + 2.5 * t * (1 - 0.5) / 0.5 + 2.5 * t * tangent + unit_m, 1e-9);
    EXPECT_NEAR(metres("urp-slope", {{"shadowDepthBias", 0.5}, {"shadowNormalBias", 0}, {"softShadowQuality", 0}}),
                2.5 * t * tangent, 1e-9);
    EXPECT_NEAR(metres("unreal", {{"ShadowBias", 0.5}, {"ShadowSlopeBias", 0.5}}), 6.25 * t, 1e-9)
        << "the slope counts up to 45 degrees";
    EXPECT_NEAR(metres("bevy", {{"shadow_depth_bias", 0.02}, {"shadow_normal_bias", 1.8}}),
                0.02 + 1.8 * std::numbers::sqrt2 * t / 0.5, 1e-9);
    EXPECT_NEAR(metres("o3de", {{"ShadowBias", 0.01}, {"NormalShadowBias", 5}}),
                0.01 + 5 * 2.0 / 2048 / 0.5 + 4 * t * tangent + 10 * unit_m, 1e-9);
    EXPECT_NEAR(metres("playcanvas", {{"shadowBias", 0.05}, {"normalOffsetBias", 0.01}}),
                0.01 / 0.5 + 0.5 * t * tangent + 0.5 * unit_m + 1e-4 * 40, 1e-9);
    EXPECT_NEAR(metres("hdrp", {{"slopeBias", 0.5}, {"normalBias", 0.75}}),
                0.75 * std::numbers::sqrt2 * t / 0.5 + 2.5 * t * tangent + unit_m + 40.0 / 65536, 1e-9);
    EXPECT_NEAR(metres("godot", {{"shadow_bias", 0.1}, {"shadow_normal_bias", 2}}),
                0.001 * 40 * 2 + 2 * t * std::sin(std::numbers::pi / 3) * tangent, 1e-9);
    EXPECT_NEAR(metres("godot", {{"shadow_bias", 0}, {"shadow_normal_bias", 2}}),
                2 * t * std::sin(std::numbers::pi / 3) * tangent, 1e-9);
    EXPECT_NEAR(metres("godot3", {{"shadow_bias", 0.02}, {"directional_shadow_normal_bias", 0.06}}), 0.02 + 0.06 * 0.5,
                1e-9);
    EXPECT_NEAR(metres("ogre", {{"depth_bias.constant", -24}, {"depth_bias.slope", -2}}), 24 * unit_m + 2 * t * tangent,
                1e-9);
    for (const double ignored : {0.0, 3.0})
        EXPECT_NEAR(metres("filament19", {{"constantBias", 0.01},
                                          {"normalBias", ignored},
                                          {"polygonOffsetSlope", 1.5},
                                          {"polygonOffsetConstant", 0}}),
                    0.01 * 2046 / 2048 + 2.5 * t * tangent, 1e-9);
    EXPECT_NEAR(metres("babylon", {{"bias", 0.0005}, {"normalBias", 0.02}, {"filter", 2}}),
                0.00025 * 40 + 0.02 * tangent, 1e-9);
}

TEST(EngineProfiles, KeepAConstantBesideTheirHiddenBiasExact) {
    Settings s = profile_settings(2.5, 0, "tent5");
    EXPECT_EQ(write_engine_values(engine_profile("urp"), s, {}).find("shadowDepthBias")->exactness,
              Exactness::EqualAtAngle);
    apply_forced_settings(engine_profile("urp"), s);
    const WrittenValues written = write_engine_values(engine_profile("urp"), s, {});
    EXPECT_NEAR(written.find("shadowDepthBias")->value, 1, 1e-9);
    EXPECT_EQ(written.find("shadowDepthBias")->exactness, Exactness::Exact);
}

TEST(EngineProfiles, TakeTheBiasOfAPlaneFromTheKernel) {
    Settings s;  // bias.kind adaptive
    set_setting(s, "filter.kernel", "pcf3");
    const BiasNumbers numbers = bias_numbers(s, {.angle_deg = 45});
    EXPECT_EQ(numbers.constant, Exactness::EqualAtAngle);
    EXPECT_NEAR(numbers.constant_texels, 2, 1e-9) << "a radius of 1, and 1 for bilinear taps";
    const WrittenValues written = write_engine_values(engine_profile("bevy"), s, {});
    EXPECT_EQ(written.find("shadow_depth_bias")->exactness, Exactness::EqualAtAngle);
    EXPECT_NE(written.find("shadow_depth_bias")->note.find("adaptive"), std::string::npos);
}

TEST(EngineProfiles, GiveNoBiasByASlopeAtAnAngleOfZero) {
    const auto has_remark = [](const ConvertedParameter& p) {
        return p.note.find("without effect at this reference angle") != std::string::npos;
    };
    for (const auto& [name, key] : {std::pair("hdrp", "slopeBias"), {"urp-slope", "shadowDepthBias"}}) {
        const WrittenValues written =
            write_engine_values(engine_profile(name), profile_settings(8, 0, "tent5"), {.angle_deg = 0});
        const ConvertedParameter* p = written.find(key);
        ASSERT_TRUE(p) << name;
        EXPECT_EQ(p->value, 0) << name;
        EXPECT_EQ(p->texels, 0) << name;
        EXPECT_TRUE(has_remark(*p)) << name << ": " << p->note;
        EXPECT_NEAR(written.wanted_texels, 8, 1e-9) << name;
        EXPECT_NEAR(written.given_texels, written.hidden_texels, 1e-9) << name;
    }
    const WrittenValues babylon =
        write_engine_values(engine_profile("babylon"), profile_settings(0, 2, "hard"), {.angle_deg = 0});
    EXPECT_EQ(babylon.find("normalBias")->value, 0);
    EXPECT_TRUE(has_remark(*babylon.find("normalBias")));
    EXPECT_NEAR(babylon.wanted_texels, 2, 1e-9);
    EXPECT_EQ(babylon.given_texels, 0) << "an offset times the sine";
}

TEST(EngineProfiles, ConvertTheShownLight) {
    Settings s;
    s.light_count = 2;
    s.view.light = 1;
    s.lights[1].cascades = 2;
    s.lights[1].split = Split::Manual;
    s.lights[1].split_1 = 0.05;
    const WrittenValues filament = write_engine_values(engine_profile("filament"), s, {.cascades = 2});
    ASSERT_TRUE(filament.find("shadowCascades"));
    EXPECT_EQ(filament.find("shadowCascades")->value, 2);
    ASSERT_TRUE(filament.find("cascadeSplitPositions[0]"));
    EXPECT_EQ(filament.find("cascadeSplitPositions[0]")->value, 0.05);
    const EngineProfile& godot = engine_profile("godot");
    EXPECT_EQ(write_engine_values(godot, s, {.cascades = 2}).find("directional_shadow_mode")->value, 1);
    const auto keys_read = [&](const char* name, const EngineValues& values) {
        std::set<std::string> keys;
        for (const ConvertedSetting& setting : read_engine_values(engine_profile(name), values, {.light = 1}))
            keys.insert(setting.key);
        return keys;
    };
    EXPECT_TRUE(keys_read("filament", {{"shadowCascades", 3}}).contains("light.1.cascades"));
    EXPECT_TRUE(keys_read("godot", {{"directional_shadow_mode", 2}}).contains("light.1.cascades"));
    EXPECT_TRUE(keys_read("filament", {{"mapSize", 512}}).contains("map.resolution")) << "of all lights";
    s.lights[1].cascades = 6;
    const std::vector<MissingSetting> missing = write_engine_values(godot, s, {.cascades = 6}).missing;
    EXPECT_TRUE(std::ranges::any_of(missing, [](const MissingSetting& m) { return m.key == "light.1.cascades"; }));
    apply_forced_settings(godot, s);
    EXPECT_EQ(s.lights[1].near_far, NearFar::Pancaking);
    EXPECT_EQ(s.lights[0].near_far, NearFar::Fitted);
}

TEST(EngineProfiles, NameEveryNumberOfCascadesThatTheyLack) {
    for (const char* name : {"godot", "godot3", "urp", "urp-slope", "filament", "filament19", "o3de"})
        for (int count = 1; count <= kMaxCascades; ++count) {
            Settings s;
            s.lights[0].cascades = count;
            const bool by_splits = std::string_view(name).starts_with("godot");
            EXPECT_EQ(lacking_setting(engine_profile(name), s, "light.cascades") != nullptr,
                      count > 4 || (by_splits && count == 3))
                << name << " " << count;
        }
}

TEST(EngineProfiles, RefuseHostileValues) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                     kInfinity = std::numeric_limits<double>::infinity();
    const EngineProfile& three = engine_profile("three");
    const EngineParameter& normal = engine_parameter(three, "NORMALBIAS");
    EXPECT_EQ(normal.key, "normalBias") << "case does not matter";
    for (const char* text : {"nan", "inf", "-inf", "1e30", "", " ", "0.1x", "--1", "0x10", "1e400", "PCFShadowMap"})
        EXPECT_THROW(parse_engine_value(three, normal, text), UsageError) << text;
    EXPECT_EQ(parse_engine_value(three, normal, "0.02"), 0.02);
    const EngineParameter& type = engine_parameter(three, "shadowMap.type");
    for (const char* text : {"", "3", "PCFSoft", "-1"}) EXPECT_THROW(parse_engine_value(three, type, text), UsageError);
    EXPECT_EQ(parse_engine_value(three, type, "vsmshadowmap"), 2);
    for (const EngineProfile& profile : engine_profiles())
        for (const EngineParameter& parameter : profile.parameters)
            for (const double value : {kNan, kInfinity, -kInfinity, 1e30, -1e30})
                EXPECT_THROW(read_engine_values(profile, {{std::string(parameter.key), value}}, {}), Error)
                    << profile.name << " " << parameter.key;
    const MapFacts bad[] = {{.width_m = kNan},   {.width_m = 0},    {.width_m = 1e30},     {.texels = 0},
                            {.depth_m = -1},     {.depth_m = kNan}, {.cascades = 99},      {.angle_deg = 90},
                            {.angle_deg = kNan}, {.angle_deg = -1}, {.view_m = kInfinity}, {.view_fov_deg = 180}};
    for (const MapFacts& facts : bad) {
        EXPECT_THROW(read_engine_values(three, {}, facts), Error);
        EXPECT_THROW(write_engine_values(three, Settings{}, facts), Error);
    }
    EXPECT_THROW(read_engine_values(three, {{"nonsense", 1}}, {}), Error);
    EXPECT_THROW(engine_profile(""), UsageError);
    try {
        engine_parameter(three, "normalbais");
        ADD_FAILURE() << "an unknown name was found";
    } catch (const UsageError& e) {
        EXPECT_NE(std::string(e.what()).find("did you mean normalBias?"), std::string::npos) << e.what();
    }
    try {
        engine_profile("godto");
        ADD_FAILURE() << "an unknown name was found";
    } catch (const UsageError& e) {
        EXPECT_NE(std::string(e.what()).find("did you mean godot?"), std::string::npos) << e.what();
    }
}

TEST(EngineProfiles, StayFiniteAtTheEndsOfAllSettings) {
    for (const EngineProfile& profile : engine_profiles())
        for (const double amount : {0.0, 1000.0})
            for (const double angle : {0.0, 89.9})
                for (const BiasUnit unit : {BiasUnit::Depth, BiasUnit::Texels, BiasUnit::Metres}) {
                    Settings s = profile_settings(amount, amount / 10, "pcf9");
                    s.bias.unit = unit;
                    s.bias.slope = amount;
                    s.bias.raster_slope = -amount / 10;
                    for (const ConvertedParameter& p :
                         write_engine_values(profile, s, {.angle_deg = angle}).parameters) {
                        EXPECT_TRUE(std::isfinite(p.value) && std::isfinite(p.texels)) << profile.name;
                        EXPECT_GE(p.value, p.parameter->min) << profile.name << " " << p.parameter->key;
                        EXPECT_LE(p.value, p.parameter->max) << profile.name << " " << p.parameter->key;
                    }
                }
}

TEST(EngineProfiles, HaveSoundRows) {
    std::set<std::string_view> names;
    for (const EngineProfile& profile : engine_profiles()) {
        EXPECT_TRUE(names.insert(profile.name).second) << profile.name;
        EXPECT_TRUE(profile.read_bias ? profile.write_bias != nullptr : !profile.unverified.empty()) << profile.name;
        std::set<std::string_view> keys;
        for (const EngineParameter& p : profile.parameters) {
            EXPECT_TRUE(keys.insert(p.key).second) << profile.name << " " << p.key;
            EXPECT_FALSE(p.meaning.empty() || p.source.empty()) << profile.name << " " << p.key;
            EXPECT_TRUE(p.standard >= p.min && p.standard <= p.max) << profile.name << " " << p.key;
            EXPECT_TRUE(p.setting.empty() || find_setting(p.setting)) << profile.name << " " << p.setting;
            if (!p.choices.empty()) {
                EXPECT_EQ(p.max, double(p.choices.size() - 1)) << profile.name << " " << p.key;
                for (std::size_t i = 0; i < p.choices.size(); ++i)
                    EXPECT_NO_THROW(read_engine_values(profile, {{std::string(p.key), double(i)}}, {}))
                        << profile.name << " " << p.key;
            }
        }
        for (const ForcedSetting& forced : profile.forced) {
            Settings s;
            EXPECT_NO_THROW(set_setting(s, forced.key, forced.value)) << profile.name;
        }
        for (const LackingSetting& row : profile.lacking) {
            Settings s;
            ASSERT_TRUE(find_setting(row.key)) << profile.name << " " << row.key;
            if (row.value.empty()) continue;
            EXPECT_NO_THROW(set_setting(s, row.key, row.value)) << profile.name;
        }
    }
    for (const char* name :
         {"three", "babylon", "playcanvas", "godot", "urp", "urp-slope", "hdrp", "unreal", "filament", "bevy", "o3de",
          "opengl", "vulkan", "d3d12", "webgpu", "godot3", "ogre", "filament19"})
        EXPECT_TRUE(names.contains(name)) << name;
}

TEST(EngineProfiles, ForceWhatCannotBeTurnedOff) {
    const EngineProfile& urp = engine_profile("urp");
    Settings s;
    EXPECT_TRUE(apply_forced_settings(urp, s).empty()) << "a default needs no remark";
    EXPECT_EQ(s.bias.raster_slope, 2.5);
    EXPECT_EQ(s.bias.raster_units, 1);
    s.bias.raster_slope = 1;
    const std::vector<std::string> notes = apply_forced_settings(urp, s);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes[0].find("bias.raster_slope: 2.5 instead of 1"), std::string::npos) << notes[0];
    EXPECT_NE(notes[0].find("SetGlobalDepthBias"), std::string::npos) << notes[0];
    EXPECT_TRUE(forced_setting(urp, "bias.raster_units"));
    EXPECT_FALSE(forced_setting(urp, "bias.normal"));
    s.bias.slope = 2;
    EXPECT_TRUE(lacking_setting(urp, s, "bias.slope"));
    EXPECT_FALSE(lacking_setting(urp, s, "bias.constant"));
}

TEST(EngineWording, SaysChangesInTheEnginesParameters) {
    using Change = std::vector<std::pair<std::string, std::string>>;
    const EngineWording three{&engine_profile("three"), {}, profile_settings(0, 0, "vogel")};
    EXPECT_EQ(three.text(Change{{"bias.normal", "1"}}), "in three.js: set normalBias to 0.0098");
    EXPECT_EQ(three.text(Change{{"bias.constant", "1.5"}}), "in three.js: set bias to -0.00037");
    EXPECT_EQ(three.text(Change{{"map.outside", "unlit"}}), "");
    const EngineWording offset{&engine_profile("three"), {}, profile_settings(0, 2, "vogel")};
    EXPECT_EQ(offset.text(Change{{"map.resolution", "1024"}}), "in three.js: set normalBias to 0.039")
        << "as many texels of the new map";
    EXPECT_EQ(EngineWording{}.text(Change{{"bias.normal", "1"}}), "");
    EngineProfile unknown = engine_profile("three");
    unknown.read_bias = nullptr;
    unknown.write_bias = nullptr;
    EXPECT_EQ((EngineWording{&unknown, {}, {}}.text(Change{{"bias.normal", "1"}})), "") << "no conversion is known";
}

TEST(EngineWording, FindsSettingsByEnginesNames) {
    EXPECT_TRUE(engine_name_matches(*find_setting("bias.normal"), "normalOffsetBias"));
    EXPECT_TRUE(engine_name_matches(*find_setting("bias.constant"), "SHADOW_DEPTH_BIAS"));
    EXPECT_FALSE(engine_name_matches(*find_setting("bias.slope"), "shadow_depth_bias"));
    for (const EngineProfile& profile : engine_profiles())
        for (const EngineParameter& p : profile.parameters)
            EXPECT_TRUE(p.setting.empty() || engine_name_matches(*find_setting(p.setting), p.key))
                << profile.name << " " << p.key;
    EXPECT_FALSE(engine_names_of(*find_setting("bias.normal")).empty());
}

}  // namespace
}  // namespace si
