// Tests of the group Engine in the settings' column: how it is found, and what typed numbers change.
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "renderer/advise/fixes.h"
#include "renderer/profiles/engine_profile.h"
#include "tests/ui/drawn_text.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/ui_harness.h"

namespace si::test {
namespace {

/// Types a number into the widget of an engine's parameter, and presses Enter.
void type_number(UiHarness& ui, const std::string& parameter, const std::string& text) {
    const std::string label = "##" + parameter;
    const auto at = ui.find("rows", "parameters", label);
    ASSERT_TRUE(at) << parameter;
    ui.click(*at);
    ui.frames(1);
    ImGui::GetIO().KeyCtrl = true;
    ui.key('A');
    ImGui::GetIO().KeyCtrl = false;
    ui.type(text);
    ui.key(ImGui::GetKeyIndex(ImGuiKey_Enter));
    ui.frames(2);
}

TEST(EnginePanel, IsFoundByItsNameAndByThoseOfEngines) {
    UiHarness ui(1280, 720);
    ui.state.engine_panel.profile = &engine_profile("three");
    for (const char* const search : {"engine", "three.js", "Bevy"}) {
        ui.state.settings_panel.search = search;
        ui.frames(3);
        EXPECT_EQ(ui.lacking({"Engine", "reference angle"}), "") << search;
    }
    ui.state.settings_panel.search = "normalBias";
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"Engine", "reference angle"}), "") << "a parameter of the chosen engine";
    ui.state.settings_panel.search = "bias.constant";
    ui.frames(3);
    EXPECT_FALSE(ui.prints("reference angle"));
}

TEST(EnginePanel, TypedNumbersChangeOurSettingsWithinTheEnginesRange) {
    UiHarness ui(1280, 720);
    ui.state.engine_panel.profile = &engine_profile("three");
    ui.state.settings_panel.search = "three.js";
    ui.frames(4);
    type_number(ui, "bias", "-0.001");
    EXPECT_EQ(ui.state.settings.bias.unit, BiasUnit::Depth);
    EXPECT_NEAR(ui.state.settings.bias.constant, 0.001, 1e-9);
    type_number(ui, "bias", "-7");
    EXPECT_NEAR(ui.state.settings.bias.constant, 1, 1e-9) << "the least number that three.js takes is -1";
}

/// Returns the number that the group Engine shows.
double shown_number(const UiHarness& ui, const char* parameter) {
    const EnginePanel& panel = ui.state.engine_panel;
    return engine_value(*panel.profile, panel.values, parameter);
}

// A frame may arrive several frames of the panel after the settings have changed.
TEST(EnginePanel, NumbersFollowTheMapOfALateFrame) {
    UiHarness ui(1280, 720);
    Settings& settings = ui.state.settings;
    settings.bias.normal = 2.6;
    ui.state.engine_panel.profile = &engine_profile("three");
    ui.state.settings_panel.search = "three.js";
    ui.frames(4);
    const double before = shown_number(ui, "normalBias");
    ui.frame_settings = settings;
    settings.map.resolution /= 2;
    ui.frames(2);
    ui.frame_settings.reset();
    ui.frames(2);
    EXPECT_NEAR(shown_number(ui, "normalBias"), 2 * before, 0.05 * before) << "texels twice as wide";
    type_number(ui, "bias", "-0.0005");
    EXPECT_NEAR(settings.bias.constant, 0.0005, 1e-9);
    EXPECT_NEAR(settings.bias.normal, 2.6, 1e-6) << "another parameter was typed";
}

TEST(EnginePanel, ATypedBiasStaysInTheEnginesUnit) {
    UiHarness ui(1280, 720);
    const EnginePanel& panel = ui.state.engine_panel;
    const BiasSettings& bias = ui.state.settings.bias;
    ui.state.engine_panel.profile = &engine_profile("three");
    ui.state.settings_panel.search = "three.js";
    ui.frames(4);
    type_number(ui, "normalBias", "0.02");
    EXPECT_NEAR(bias.normal * panel.facts.texel_m(), 0.02, 1e-6);
    type_number(ui, "mapSize", "1024");
    ui.frames(6);
    EXPECT_EQ(ui.state.settings.map.resolution, 1024);
    EXPECT_EQ(panel.facts.texels, 1024);
    EXPECT_NEAR(bias.normal * panel.facts.texel_m(), 0.02, 1e-6);
    EXPECT_NEAR(shown_number(ui, "normalBias"), 0.02, 1e-9);
    EXPECT_EQ(shown_number(ui, "mapSize"), 1024);
}

TEST(EnginePanel, EveryParameterOfTheBiasChangesIt) {
    UiHarness ui(1280, 720);
    const BiasSettings& bias = ui.state.settings.bias;
    ui.state.engine_panel.profile = &engine_profile("godot");
    ui.state.settings_panel.search = "Godot 4";
    ui.frames(4);
    type_number(ui, "shadow_bias", "0.1");
    type_number(ui, "shadow_normal_bias", "0");
    const double before = bias.constant;
    EXPECT_GT(before, 0);
    type_number(ui, "shadow_blur", "2");
    EXPECT_NEAR(bias.constant, 2 * before, 1e-6 * before);
    EXPECT_EQ(shown_number(ui, "shadow_blur"), 2);
    EXPECT_NEAR(shown_number(ui, "shadow_bias"), 0.1, 1e-9);
}

TEST(EnginePanel, NumbersAreThoseOfTheShownLight) {
    UiHarness ui(1280, 720);
    Settings& settings = ui.state.settings;
    settings.light_count = 2;
    settings.view.light = 1;
    ui.state.engine_panel.profile = &engine_profile("filament");
    ui.state.settings_panel.search = "filament";
    ui.frames(4);
    type_number(ui, "shadowCascades", "3");
    EXPECT_EQ(settings.lights[1].cascades, 3);
    EXPECT_EQ(settings.lights[0].cascades, 1);
}

TEST(EnginePanel, TheAngleIsThatOfTheConversion) {
    UiHarness ui(1280, 720);
    ui.state.engine_panel.profile = &engine_profile("playcanvas");
    ui.state.settings_panel.search = "playcanvas";
    ui.frames(4);
    type_number(ui, "reference angle", "60");
    EXPECT_EQ(ui.state.engine_panel.angle_deg, 60);
    EXPECT_TRUE(ui.drawn().find(U"m,60°"));
    type_number(ui, "reference angle", "95");
    EXPECT_EQ(ui.state.engine_panel.angle_deg, 89) << "a plane at 90 degrees is not lit";
}

// Fixes are listed with the numbers of the chosen engine.
TEST(EnginePanel, FixesNameTheEnginesNumber) {
    UiHarness ui(1600, 900);
    ui.state.engine_panel.profile = &engine_profile("three");
    FixTable table;
    Trial trial;
    trial.candidate.name = "more normal offset";
    trial.changes = {{"bias.normal", "2.5"}};
    trial.cured = 3;
    table.rows.push_back(trial);
    table.wrong = 5;
    table.candidates = 1;
    table.refused = 4;
    ui.fixes = {.running = {}, .table = &table, .pixel = {}, .current = true};
    ui.state.window.open_page = Page::Improve;
    ui.frames(4);
    EXPECT_EQ(ui.lacking({"more normal offset", "in three.js: set normalBias to", "4 more: the chosen engine lacks"}),
              "");
    ui.state.engine_panel.profile = nullptr;
    ui.frames(3);
    EXPECT_FALSE(ui.prints("in three.js"));
}

TEST(EnginePanel, TooltipsOfSettingsSayTheConversion) {
    UiHarness ui(1280, 720);
    ui.state.settings_panel.search = "normalBias";
    ui.frames(3);
    constexpr glm::vec2 kFirstLabel{965, 142};
    ui.move(kFirstLabel);
    ui.frames(60);
    EXPECT_EQ(ui.lacking({"three.js normalBias (m)", "texels"}), "");
}

TEST(EditorEnginePanel, ProfileOfTheCommandLineIsChosen) {
    EditorOptions options = editor_options("boxes", {"engine.bias=-0.0005", "engine.angle=30"});
    options.session.profile = "three";
    TestEditor editor(options);
    EXPECT_EQ(editor.state().engine_panel.profile, &engine_profile("three"));
    EXPECT_EQ(editor.state().engine_panel.angle_deg, 30);
    EXPECT_NEAR(engine_value(engine_profile("three"), editor.state().engine_panel.values, "bias"), -0.0005, 1e-9);
    const DrawnText text;
    editor.frames(2);
    for (const char* shown : {"three.js", "normalBias", "reference angle"})
        EXPECT_TRUE(text.shows(std::string(shown))) << shown;
}

}  // namespace
}  // namespace si::test
