// Tests of single keys that change settings, over made-up frames. The real window replays them in its jobs.
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "renderer/advise/fixes.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/param.h"
#include "tests/support/sets.h"
#include "tests/support/text.h"
#include "tests/ui/ui_harness.h"

namespace si::test {
namespace {

/// Table with one fix.
FixTable fix_of(SettingChanges changes) {
    FixTable table;
    table.rows = {{.candidate = {.name = "made up"}, .changes = std::move(changes)}};
    return table;
}
PixelDiagnosis wrong_pixel(int light = 0) {
    PixelDiagnosis d;
    d.light = light;
    d.right = false;
    d.reference.cause.artefact = Artefact::Acne;
    return d;
}

struct Keys : testing::Test {
    UiHarness ui{1280, 720};
    FixTable table;
    void find_fix(SettingChanges changes) {
        table = fix_of(std::move(changes));
        ui.fixes = {.running = {}, .table = &table, .pixel = ui.state.probe_pixel, .current = true};
    }
    Keys() { ui.frames(3); }
    void key(int code) { ui.key(code); }
    std::string last_line() const {
        return ui.state.log.lines().empty() ? std::string() : ui.state.log.lines().back().text;
    }
    Settings& settings() { return ui.state.settings; }
};

TEST_F(Keys, CAppliesTheFixThatWasTried) {
    ui.diagnoses = {wrong_pixel()};
    ui.state.probe_pixel = glm::ivec2(3, 4);
    find_fix({{"bias.slope", "4.5"}, {"bias.normal", "1"}});
    ui.frames(2);
    const Settings before = settings();
    key('C');
    EXPECT_EQ(settings().bias.slope, 4.5);
    EXPECT_EQ(settings().bias.normal, 1);
    EXPECT_EQ(ui.state.history.undo(), before) << "one step";
}

TEST_F(Keys, CAppliesNoFixOfAnotherPixelOrOtherSettings) {
    ui.diagnoses = {wrong_pixel()};
    ui.state.probe_pixel = glm::ivec2(3, 4);
    find_fix({{"bias.slope", "4.5"}});
    ui.fixes.pixel = glm::ivec2(5, 6);
    ui.frames(2);
    const Settings before = settings();
    key('C');
    EXPECT_EQ(settings(), before);
    ui.fixes.pixel = ui.state.probe_pixel;
    ui.fixes.current = false;
    key('C');
    EXPECT_EQ(settings(), before);
}

TEST_F(Keys, CWithoutAFixChangesNothing) {
    ui.diagnoses = {PixelDiagnosis{}};
    ui.state.probe_pixel = glm::ivec2(3, 4);
    ui.frames(2);
    const Settings before = settings();
    key('C');
    EXPECT_EQ(settings(), before);
    EXPECT_EQ(test::lacking(last_line(), {"this pixel is right"}), "") << "but it is said";
    ui.diagnoses = {wrong_pixel()};
    find_fix({{"bias.slope", "4.5"}});
    table.rows[0].why_not = "the mean error rises";
    ui.frames(2);
    key('C');
    EXPECT_EQ(settings(), before);
    EXPECT_EQ(test::lacking(last_line(), {"no tried change"}), "");
}

TEST_F(Keys, CPressedBeforeTheVerdictAppliesLater) {
    ui.diagnoses = {wrong_pixel()};  // diagnosis of the previous picture
    ui.verdict_follows = true;
    ui.state.probe_pixel = glm::ivec2(3, 4);
    find_fix({{"bias.slope", "7"}});
    ui.frames(2);
    const Settings before = settings();
    key('C');
    EXPECT_EQ(settings(), before);
    ui.verdict_follows = false;
    ui.tracing_probe = true;
    ui.diagnoses.clear();
    ui.frames(3);
    EXPECT_EQ(settings(), before);
    ui.tracing_probe = false;
    ui.diagnoses = {wrong_pixel()};
    ui.fixes = {.running = SearchProgress{"least bias", 0.1}};
    ui.frames(2);
    EXPECT_EQ(settings(), before) << "changes are being tried";
    find_fix({{"bias.slope", "4.5"}});
    ui.frames(2);
    EXPECT_EQ(settings().bias.slope, 4.5);
    settings().bias.slope = 1;
    ui.frames(2);
    EXPECT_EQ(settings().bias.slope, 1) << "once";
    // X's search replaces the pixel.
    ui.state.probe_pixel.reset();
    ui.state.artefact_tour.waits_for = 5;
    key('C');
    ui.frames(2);
    EXPECT_EQ(settings().bias.slope, 1);
    ui.state.artefact_tour.waits_for = 0;
    ui.state.probe_pixel = glm::ivec2(3, 4);
    ui.frames(2);
    EXPECT_EQ(settings().bias.slope, 4.5);
    settings().bias.slope = 1;
    ui.frames(2);
    // A click selects another pixel, without a pending request.
    ui.verdict_follows = true;
    key('C');
    ui.click(glm::vec2(ui.state.viewport.view->origin + 0.3 * ui.state.viewport.view->size));
    ui.verdict_follows = false;
    ui.frames(2);
    EXPECT_EQ(settings().bias.slope, 1);
}

TEST_F(Keys, PageDownOnlyOpensAPreset) {
    ImGuiIO& io = ImGui::GetIO();
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    io.KeyMap[ImGuiKey_PageUp] = 401;
    io.KeyMap[ImGuiKey_PageDown] = 402;
    for (const char* key : {"one", "two"}) ui.presets.emplace_back().key = key;
    ui.frames(2);
    ImGui::SetWindowFocus("editor");
    const auto search = ui.find("/settings_", "search", "##text");
    ASSERT_TRUE(search);
    ui.click(*search + glm::vec2(0, 60));  // a click among the settings
    const ImGuiID focused = ImGui::GetCurrentContext()->NavId;
    EXPECT_TRUE(ui.key(402).load_preset);
    ui.frames(2);
    EXPECT_EQ(ImGui::GetCurrentContext()->NavId, focused);
    EXPECT_TRUE(ImGui::GetCurrentContext()->NavDisableHighlight);
}

/// Returns the top-level part of the window that has the keyboard: "editor/inspector".
std::string focused_part() {
    const ImGuiWindow* window = ImGui::GetCurrentContext()->NavWindow;
    const std::string name = window ? window->Name : "";
    return name.substr(0, name.find('_'));
}

TEST_F(Keys, F6GivesTheKeyboardToEachPanelAndShowsIt) {
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    ui.state.layout.map_place = MapSpot::Hidden;
    ui.state.probe_pixel = glm::ivec2(3, 4);
    ui.state.keyboard.probe_has_arrows = true;
    ui.frames(2);
    for (const char* part : {"editor/top", "editor/scene", "editor/bottom", "editor/inspector", "editor/status"}) {
        key(295);
        ui.frames(2);
        EXPECT_EQ(focused_part(), part);
        EXPECT_FALSE(ImGui::GetCurrentContext()->NavDisableHighlight) << part;
        EXPECT_FALSE(ui.state.keyboard.probe_has_arrows);
    }
    ImGui::GetIO().KeyShift = true;
    key(295);
    ImGui::GetIO().KeyShift = false;
    ui.frames(2);
    EXPECT_EQ(focused_part(), "editor/inspector");
    key(299);  // F10
    ui.frames(2);
    EXPECT_EQ(focused_part(), "editor/top");
    EXPECT_NE(ImGui::GetCurrentContext()->NavId, 0u);
}

TEST_F(Keys, CombosOpenAndChooseByKeyboard) {
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    ui.state.layout = {.map_place = MapSpot::Hidden};
    ui.frames(2);
    ui.state.keyboard.wanted = WindowPart::Inspector;
    ui.frames(3);
    const ImGuiContext& g = *ImGui::GetCurrentContext();
    const auto key_of = [](ImGuiKey key) { return ImGui::GetKeyIndex(key); };
    const auto combo = [] {
        const ImGuiWindow* const rows = UiHarness::window("/rows_");
        const ImGuiID group = ImHashStr("rows", 0, ImHashStr("filter", 0, rows->ID));
        return ImHashStr("##value", 0, ImHashStr("filter.kernel", 0, group));
    };
    const int before = settings().filter.kernel;
    for (int i = 0; i < 40 && g.NavId != combo(); ++i) {
        key(key_of(ImGuiKey_DownArrow));
        ui.frames(2);
    }
    ASSERT_EQ(g.NavId, combo()) << "the arrows do not reach it";
    key(key_of(ImGuiKey_Space));
    ui.frames(3);
    ASSERT_EQ(g.OpenPopupStack.Size, 1);
    key(key_of(ImGuiKey_DownArrow));
    ui.frames(2);
    key(key_of(ImGuiKey_Space));
    ui.frames(3);
    EXPECT_EQ(g.OpenPopupStack.Size, 0);
    EXPECT_NE(settings().filter.kernel, before);
}

TEST_F(Keys, CtrlFSearchesTheSettings) {
    ui.state.window.maximised = Panel::Scene;
    ui.frames(2);
    ImGui::GetIO().KeyCtrl = true;
    key('F');
    ImGui::GetIO().KeyCtrl = false;
    ui.frames(3);
    ui.type("bias");
    EXPECT_EQ(ui.state.settings_panel.search, "bias");
    EXPECT_FALSE(ui.state.window.maximised);
    ui.key(ImGui::GetKeyIndex(ImGuiKey_Escape));
    // From another tab, too.
    ui.state.window.open_page = Page::Objects;
    ui.frames(3);
    ImGui::GetIO().KeyCtrl = true;
    key('F');
    ImGui::GetIO().KeyCtrl = false;
    ui.frames(4);
    EXPECT_TRUE(ui.state.shows(Page::Settings));
    ui.type("x");
    EXPECT_NE(ui.state.settings_panel.search.find('x'), std::string::npos);
}

TEST_F(Keys, CtrlAndADigitOpenATab) {
    const int overlay = settings().view.overlay;
    for (int tab = 0; tab < 10; ++tab) {
        ImGui::GetIO().KeyCtrl = true;
        key('0' + (tab + 1) % 10);
        ImGui::GetIO().KeyCtrl = false;
        ui.frames(3);
        EXPECT_TRUE(ui.state.shows(first_pages()[std::size_t(tab)])) << tab;
        EXPECT_EQ(settings().view.overlay, overlay);
    }
}

TEST_F(Keys, JOpensAndClosesTheStrip) {
    ui.state.layout.strip_open = false;
    for (const bool open : {true, false}) {
        key('J');
        ui.frames(3);
        EXPECT_EQ(ui.state.layout.strip_open, open);
        EXPECT_EQ(ui.state.strip_page.has_value(), open);
    }
    ui.state.window.maximised = Panel::Scene;
    key('J');
    ui.frames(3);
    EXPECT_TRUE(ui.state.strip_page) << "it is seen";
}

TEST_F(Keys, IOpensImproveAndChoosesItsNextAim) {
    ui.state.improve.mode = ImproveMode::Cheaper;
    for (const ImproveMode mode : {ImproveMode::Cheaper, ImproveMode::Limits, ImproveMode::Pixel}) {
        key('I');
        ui.frames(3);
        EXPECT_TRUE(ui.state.shows(Page::Improve));
        EXPECT_EQ(ui.state.improve.mode, mode);
    }
}

TEST_F(Keys, QReportsItsResult) {
    ui.state.probe_pixel.reset();
    key('Q');
    EXPECT_EQ(test::lacking(last_line(), {"No stored-depth quads to show"}), "");
}

TEST_F(Keys, XReportsItsSearch) {
    for (const char* said : {"Looking", "Still looking"}) {
        key('X');
        EXPECT_EQ(test::lacking(last_line(), {said}), "");
    }
}

TEST_F(Keys, PComparesWithThePinIfNothingIsCompared) {
    key('P');
    EXPECT_EQ(ui.state.compare.kind, CompareKind::Pinned);
    EXPECT_FALSE(ui.state.comparison.reference);
    key('P');  // off
    ui.state.comparison.view = ComparisonView::Swipe;
    ui.state.comparison.reference = true;
    key('P');
    EXPECT_TRUE(ui.state.comparison.reference) << "what is compared stays";
}

TEST_F(Keys, URemovesAllBias) {
    settings().bias = {.constant = 1, .slope = 2, .normal = 3, .raster_slope = 4, .raster_units = 5};
    key('U');
    const BiasSettings& b = settings().bias;
    for (const double left : {b.constant, b.slope, b.normal, b.raster_slope, b.raster_units}) EXPECT_EQ(left, 0);
    EXPECT_EQ(bias_of(settings()).key, "constant") << "the default kind computes a bias itself";
    settings() = slope_settings();
    key('U');
    EXPECT_EQ(bias_of(settings()).key, "slope");
    EXPECT_EQ(settings().bias.normal, 0);
}

TEST_F(Keys, TCyclesThroughTheTypesOfTheShownLight) {
    settings().light_count = 2;
    settings().view.light = 1;
    for (const LightType next : {LightType::Spot, LightType::Point, LightType::Directional}) {
        key('T');
        EXPECT_EQ(settings().lights[1].type, next);
    }
    EXPECT_EQ(settings().lights[0].type, LightType::Directional);
}

TEST_F(Keys, BracketsHalveAndDoubleTheResolutionWithinItsRange) {
    settings().map.resolution = 2048;
    key('[');
    EXPECT_EQ(settings().map.resolution, 1024);
    key(']');
    key(']');
    EXPECT_EQ(settings().map.resolution, 4096);
    for (int i = 0; i < 20; ++i) key(']');
    EXPECT_EQ(settings().map.resolution, int(find_setting("map.resolution")->param->max));
    for (int i = 0; i < 20; ++i) key('[');
    EXPECT_EQ(settings().map.resolution, int(find_setting("map.resolution")->param->min));
}

TEST_F(Keys, QTogglesTheTexelQuadsOfTheProbedPixel) {
    ui.state.probe_pixel = glm::ivec2(3, 4);
    ui.frames(2);
    key('Q');
    const ViewSettings& v = settings().view;
    EXPECT_EQ(v.slabs, Slabs::Both);
    const int n = settings().map.resolution;
    EXPECT_DOUBLE_EQ(v.slabs_u, 5.5 / n) << "the texel that made-up probes find";
    EXPECT_DOUBLE_EQ(v.slabs_v, 7.5 / n);
    key('Q');
    EXPECT_EQ(v.slabs, Slabs::None);
    ui.state.probe_pixel.reset();
    ui.frames(2);
    key('Q');
    EXPECT_EQ(v.slabs, Slabs::None) << "nothing is pointed at";
}

TEST_F(Keys, LetterThatArrivesWithTheClickIntoAFieldIsOnlyTyped) {
    const auto field = ui.drawn().find(U"Searchsettings");
    ASSERT_TRUE(field);
    ui.move({field->x, field->y});
    ui.frames(2);
    const Settings before = settings();
    ui.press(true);
    ImGui::GetIO().KeysDown['L'] = true;
    ImGui::GetIO().AddInputCharacter('l');
    ui.frame();
    ui.press(false);
    ImGui::GetIO().KeysDown['L'] = false;
    ui.frames(2);
    EXPECT_EQ(ui.state.settings_panel.search, "l");
    EXPECT_EQ(settings(), before) << "the view went through the light";
    // Outside fields the key acts, with a press or without.
    ui.state.settings_panel.search.clear();
    ui.click({4, 4});  // leaves the field
    ui.frames(2);
    ui.press(true);
    ImGui::GetIO().KeysDown['L'] = true;
    ui.frame();
    ui.press(false);
    ImGui::GetIO().KeysDown['L'] = false;
    ui.frames(2);
    EXPECT_NE(settings(), before);
}

}  // namespace
}  // namespace si::test
