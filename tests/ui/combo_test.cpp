// Tests of combo boxes: one press moves from one combo to the next, and long texts end in an ellipsis.
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <string>

#include "renderer/settings/param.h"
#include "tests/support/sets.h"
#include "tests/ui/screen.h"
#include "tests/ui/ui_harness.h"

namespace si::test {
namespace {

/// Finds a setting's combo in the map's header.
ImGuiID combo_in_map(const char* key) {
    return ImHashStr("##value", 0, ImHashStr(key, 0, UiHarness::window("editor/map_")->ID));
}

bool is_only_open(ImGuiID combo) {
    const ImVector<ImGuiPopupData>& open = ImGui::GetCurrentContext()->OpenPopupStack;
    return open.Size == 1 && open[0].PopupId == ImHashStr("##ComboPopup", 0, combo);
}

bool none_open() {
    return ImGui::GetCurrentContext()->OpenPopupStack.Size == 0;
}

TEST(Combo, PressThatClosesOneOpensTheNext) {
    UiHarness ui(kWidth, kHeight);
    ui.frames(3);
    const ImGuiID source = combo_in_map("view.map_source"), shown = combo_in_map("view.map");
    const auto at_source = ui.find("editor/map", "view.map_source", "##value"),
               at_shown = ui.find("editor/map", "view.map", "##value");
    ASSERT_TRUE(at_source && at_shown);
    ui.click(*at_source);
    EXPECT_TRUE(is_only_open(source));
    ui.click(*at_shown);
    EXPECT_TRUE(is_only_open(shown)) << "which is drawn after it";
    ui.click(*at_source);
    EXPECT_TRUE(is_only_open(source)) << "which is drawn before it";
    ui.click(*at_source);
    EXPECT_TRUE(none_open()) << "a press on its own combo closes a list";
    ui.click(ui.find("editor/top", "", "File"));
    ui.click(*at_shown);
    EXPECT_TRUE(is_only_open(shown)) << "a menu was open";
    // The pressed row is selected.
    const MapView before = ui.state.settings.view.map;
    ui.frames(2);
    const int wanted = before == MapView::Raw ? 1 : 0;
    const auto label = find_setting("view.map")->param->choices()[std::size_t(wanted)].label;
    const auto line = ui.find_choice(wanted, std::string(label));
    ASSERT_TRUE(line);
    ui.click(*line);
    EXPECT_EQ(ui.state.settings.view.map, MapView(wanted));
    EXPECT_TRUE(none_open());
}

TEST(Combo, ListsStayOnTheScreenWhereverTheirComboStands) {
    for (const float share : {0.1f, 0.3f, 0.5f, 0.62f}) {
        UiHarness ui(kWidth, kHeight);
        ui.state.layout.map_height = share;
        ui.frames(4);
        const auto kernel = ui.find("/rows_", [](ImGuiID window) {
            const ImGuiID table = ImHashStr("rows", 0, ImHashStr("filter", 0, window));
            return ImHashStr("##value", 0, ImHashStr("filter.kernel", 0, table));
        });
        if (!kernel) continue;  // scrolled away
        ui.click(*kernel);
        ui.frames(3);
        const ImGuiWindow* list = UiHarness::window("##Combo");
        ASSERT_TRUE(list) << share;
        EXPECT_GE(list->Pos.y, 0) << share;
        EXPECT_LE(list->Pos.y + list->Size.y, kHeight) << share;
        EXPECT_LE(list->Pos.x + list->Size.x, kWidth) << share;
    }
}

TEST(Combo, PressElsewhereOnlyClosesTheList) {
    UiHarness ui(kWidth, kHeight);
    ui.frames(3);
    ui.click(ui.find("editor/map", "view.map_source", "##value"));
    ui.click({200, 300});
    EXPECT_TRUE(none_open());
    EXPECT_FALSE(ui.state.probe_pixel) << "the press is not the scene's";
}

TEST(Combo, KindOfBiasBringsItsStartingValuesAsOneStepOfUndo) {
    UiHarness ui(kWidth, kHeight);
    ui.frames(3);
    const Settings before = ui.state.settings;
    ui.click(ui.find("/rows_", [](ImGuiID window) {
        const ImGuiID table = ImHashStr("rows", 0, ImHashStr("bias", 0, window));
        return ImHashStr("##value", 0, ImHashStr("bias.kind", 0, table));
    }));
    ui.frames(2);
    const auto choices = find_setting("bias.kind")->param->choices();
    const auto slope = std::ranges::find(choices, "slope", &Choice::key);
    ui.click(ui.find_choice(int(slope - choices.begin()), std::string(slope->label)).value_or(glm::vec2(0)));
    ui.frames(3);
    EXPECT_EQ(ui.state.settings, slope_settings(before));
    EXPECT_EQ(ui.state.history.undo(), before);
    EXPECT_FALSE(ui.state.history.can_undo());
}

TEST(Combo, LongTextEndsInAnEllipsis) {
    UiHarness ui(kWidth, kHeight);
    ui.state.settings.lights[0].cascades = 3;
    ui.frames(3);
    const std::u32string text = ui.printed(), whole = U"cascade1of3";
    bool cut = false;
    for (std::size_t at = 0; (at = text.find(U"cascade", at)) != std::u32string::npos; ++at)
        cut |= text.substr(at, whole.size()).find(U'\u2026') != std::u32string::npos;
    EXPECT_TRUE(cut) << "in the map's header";
}

}  // namespace
}  // namespace si::test
