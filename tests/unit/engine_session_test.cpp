// Tests of sessions in an engine's parameters: --profile and --set engine.NAME=VALUE.
#include "app/session/engine_session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/session/session.h"
#include "renderer/base/error.h"
#include "renderer/profiles/bias_numbers.h"
#include "renderer/settings/biases.h"
#include "tests/support/error_text.h"
#include "tests/support/sets.h"

namespace si {
namespace {

Session engine_session(const std::string& profile, std::vector<std::string> sets, const std::string& preset = {}) {
    return open_session({.scene = "boxes", .preset = preset, .sets = std::move(sets), .profile = profile});
}

std::string engine_refusal(const std::string& profile, std::vector<std::string> sets) {
    try {
        engine_session(profile, std::move(sets));
    } catch (const UsageError& e) {
        return e.what();
    }
    return {};
}

bool has_note(const Session& session, std::string_view part) {
    return std::ranges::any_of(session.notes,
                               [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

TEST(EngineSession, DrawsTheEnginesNumbers) {
    const Session s = engine_session("three", {"engine.normalBias=0.02", "engine.bias=-0.0005"});
    EXPECT_EQ(bias_of(s.settings).key, "constant");
    EXPECT_EQ(s.settings.bias.unit, BiasUnit::Depth);
    EXPECT_NEAR(s.settings.bias.constant, 0.0005, 1e-12);
    const double texel_m = map_facts(s.scene, s.settings).texel_m();
    EXPECT_NEAR(s.settings.bias.normal * texel_m, 0.02, 1e-3 * 0.02) << "metres under the map that is drawn";
    EXPECT_EQ(s.settings.map.format, MapFormat::D24) << "what the engine fixes";
    ASSERT_TRUE(s.engine.profile);
    EXPECT_EQ(s.engine.facts.texels, s.settings.map.resolution);
}

TEST(EngineSession, TakesTheEnginesDefaultsWithoutPresetAndBias) {
    const Session urp = engine_session("urp", {});
    EXPECT_EQ(urp.settings.bias.constant, 2.5) << "1 times the radius of the medium filter";
    EXPECT_EQ(urp.settings.bias.raster_slope, 2.5);
    EXPECT_EQ(urp.settings.filter.size, 5);
    EXPECT_EQ(urp.settings.bias.normal_by, OffsetBy::OneMinusCosine) << "URP's own rule, exact at every angle";
    EXPECT_FALSE(has_note(urp, "degrees only"));
    const Session own = engine_session("urp", {"bias.kind=constant", "bias.constant=7"});
    EXPECT_EQ(own.settings.bias.constant, 7) << "an own bias stays";
    EXPECT_EQ(own.settings.bias.raster_slope, 2.5) << "hidden bias is added";
    const Session preset = engine_session("bevy", {}, "acne");
    EXPECT_EQ(preset.settings.bias, open_session({.scene = "boxes", .preset = "acne", .sets = {}}).settings.bias)
        << "a preset's bias stays";
    EXPECT_TRUE(preset.settings.map.reversed_z);
    const Session typed = engine_session("bevy", {"engine.shadow_depth_bias=0.5"}, "acne");
    EXPECT_EQ(typed.settings.bias.unit, BiasUnit::Metres);
    EXPECT_NEAR(typed.settings.bias.constant, 0.5, 1e-9) << "but a typed number wins";
}

TEST(EngineSession, ReadsChoicesAndTakesTheEnginesRuleOfTheOffset) {
    const Session s = engine_session(
        "three", {"engine.shadowMap.type=BasicShadowMap", "engine.shadowSide=BackSide", "engine.mapSize=512"});
    EXPECT_EQ(s.settings.map.resolution, 512);
    EXPECT_EQ(s.settings.caster.cull, Cull::Front);
    for (const char* angle : {"engine.angle=30", "engine.angle=60"}) {
        const Session babylon = engine_session("babylon", {"engine.normalBias=0.02", angle});
        EXPECT_EQ(babylon.settings.bias.normal_by, OffsetBy::Sine) << angle;
        EXPECT_NEAR(babylon.settings.bias.normal * babylon.engine.facts.texel_m(), 0.02, 1e-9) << angle;
    }
    EXPECT_EQ(engine_session("three", {"filter.kernel=pcf3", "map.resolution=256"}).settings.map.resolution, 256)
        << "own settings win over the engine's defaults";
}

TEST(EngineSession, CascadesShareTheMapOfTheEngine) {
    const auto resolution = [](const std::string& profile, std::vector<std::string> sets) {
        return engine_session(profile, std::move(sets)).settings.map.resolution;
    };
    const std::string atlas = "engine.mainLightShadowmapResolution=2048", four = "engine.shadowCascadeCount=4";
    EXPECT_EQ(resolution("urp", {atlas}), 2048);
    EXPECT_EQ(resolution("urp", {atlas, four}), 1024);
    EXPECT_EQ(resolution("urp", {atlas, "light.cascades=4"}), 1024) << "an own number of cascades";
    EXPECT_EQ(resolution("urp", {atlas, four, "map.resolution=512"}), 512) << "an own resolution";
    EXPECT_EQ(resolution("playcanvas", {"engine.shadowResolution=2048", "engine.numCascades=2"}), 1024);
    EXPECT_EQ(resolution("bevy", {"engine.size=2048", "engine.num_cascades=4"}), 2048) << "a map for each";
}

TEST(EngineSession, SetsTheShownLight) {
    const Session s = engine_session("filament", {"light.count=2", "view.light=1", "engine.shadowCascades=3"});
    EXPECT_EQ(s.settings.lights[1].cascades, 3);
    EXPECT_EQ(s.settings.lights[0].cascades, 1);
}

TEST(EngineSession, SaysWhatIsWrong) {
    EXPECT_NE(engine_refusal("three", {"engine.normalbais=1"}).find("did you mean normalBias?"), std::string::npos);
    EXPECT_NE(engine_refusal("", {"engine.bias=1"}).find("need --profile"), std::string::npos);
    EXPECT_NE(engine_refusal("thre", {}).find("did you mean three?"), std::string::npos);
    EXPECT_NE(engine_refusal("urp", {"bias.raster_slope=0"}).find("fixes it at 2.5"), std::string::npos);
    EXPECT_EQ(engine_refusal("urp", {"bias.raster_slope=2.5"}), "") << "the fixed value itself";
    for (const char* text : {"nan", "inf", "1e30", "", "abc"})
        EXPECT_FALSE(engine_refusal("three", {std::string("engine.normalBias=") + text}).empty()) << text;
    for (const char* text : {"nan", "90", "-1", "", "x"})
        EXPECT_FALSE(engine_refusal("three", {std::string("engine.angle=") + text}).empty()) << text;
}

TEST(EngineSession, NamesWhatTheEngineLacks) {
    EXPECT_TRUE(has_note(engine_session("godot", {"bias.kind=slope", "bias.slope=2"}), "Godot has no slope bias"));
    EXPECT_TRUE(has_note(engine_session("unreal", {}), "not verified"));
}

TEST(EngineSession, KeepsHiddenBiasInASearch) {
    const EngineProfile& urp = engine_profile("urp");
    EXPECT_EQ(with_hidden_bias(urp, {}, {}).raster_slope, 2.5);
    const MapFacts facts;
    const BiasSettings of_playcanvas = with_hidden_bias(engine_profile("playcanvas"), {}, facts);
    EXPECT_NEAR(of_playcanvas.constant * facts.texel_m(), 1e-4 * facts.depth_m, 1e-12) << "in texels";
    BiasSettings large{.unit = BiasUnit::Metres, .constant = 1};
    EXPECT_EQ(with_hidden_bias(engine_profile("hdrp"), large, facts).constant, 1) << "more than is hidden stays";
    EXPECT_FALSE(has_bias_row(urp, "adaptive"));
    EXPECT_TRUE(has_bias_row(urp, "constant"));
    EXPECT_TRUE(has_bias_row(engine_profile("opengl"), "adaptive"));
    for (const EngineProfile& profile : engine_profiles())
        for (const std::string_view row : profile.bias_rows)
            EXPECT_NE(std::ranges::find(biases(), row, &Bias::key), biases().end()) << profile.name << " " << row;
}

TEST(EngineSession, NamesWhyAnEngineCannotDrawAChange) {
    const Settings base = engine_session("three", {}).settings;
    const auto reason = [&](const char* key, const char* value) {
        return reason_engine_lacks(engine_profile("three"), base, settings_with(base, {{key, value}}));
    };
    EXPECT_NE(reason("map.format", "d16").find("24-bit"), std::string::npos) << "fixed";
    EXPECT_NE(reason("bias.raster_slope", "2").find("customDepthMaterial"), std::string::npos) << "lacking";
    EXPECT_NE(reason("bias.kind", "adaptive").find("no such bias"), std::string::npos);
    EXPECT_NE(reason("filter.kernel", "msm_hamburger").find("no such choice"), std::string::npos);
    EXPECT_EQ(reason("filter.kernel", "hard"), "");
    EXPECT_EQ(reason("bias.normal", "2"), "");
    EXPECT_EQ(reason("map.resolution", "4096"), "");
}

}  // namespace
}  // namespace si
