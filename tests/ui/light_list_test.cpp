// Tests of adding, copying, deleting and reordering lights, as functions on settings and by buttons.
#include "ui/state/light_list.h"

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <cmath>
#include <functional>

#include "tests/ui/ui_harness.h"

namespace si::test {
namespace {

/// Makes lights with azimuths 10, 20, ...
Settings with_lights(int count) {
    Settings s;
    s.light_count = count;
    for (int i = 0; i < count; ++i) s.lights[std::size_t(i)].azimuth = 10.0 * (i + 1);
    return s;
}

std::vector<double> azimuths(const Settings& s) {
    std::vector<double> out;
    for (int i = 0; i < s.light_count; ++i) out.push_back(s.lights[std::size_t(i)].azimuth);
    return out;
}

TEST(LightList, CopiesFollowTheirOriginal) {
    Settings s = with_lights(3);
    s.lights[1].cast = false;
    s.lights[1].name = "key";
    copy_light(s, 1);
    EXPECT_EQ(s.lights[1].name, "key");
    EXPECT_EQ(s.lights[2].name, "") << "two of one name would not be told apart";
    EXPECT_EQ(azimuths(s), (std::vector<double>{10, 20, 20, 30}));
    EXPECT_FALSE(s.lights[2].cast);
    EXPECT_EQ(s.view.light, 2);
    const Settings before = s;
    copy_light(s, 4);
    copy_light(s, -1);
    EXPECT_EQ(s, before) << "there is no such light";
    s = with_lights(kMaxLights);
    copy_light(s, 0);
    add_light(s);
    EXPECT_EQ(s, with_lights(kMaxLights)) << "there is no room";
}

TEST(LightList, DeletedLightsLeaveNoTraceAndTheShownOneStays) {
    Settings s = with_lights(3);
    s.view.light = 2;
    delete_light(s, 0);
    EXPECT_EQ(azimuths(s), (std::vector<double>{20, 30}));
    EXPECT_EQ(s.view.light, 1) << "the same light";
    EXPECT_EQ(s.lights[2], LightSettings());
    delete_light(s, 1);
    EXPECT_EQ(s.view.light, 0);
    delete_light(s, 0);
    EXPECT_EQ(s.light_count, 0);
    delete_light(s, 0);
    EXPECT_EQ(s.light_count, 0);
    add_light(s);
    EXPECT_EQ(azimuths(s), std::vector<double>{LightSettings().azimuth});
}

TEST(LightList, MovesStopAtTheEndsOfTheList) {
    Settings s = with_lights(4);
    move_light(s, 0, 2);
    EXPECT_EQ(azimuths(s), (std::vector<double>{20, 30, 10, 40}));
    EXPECT_EQ(s.view.light, 2);
    move_light(s, 2, -9);
    EXPECT_EQ(azimuths(s), (std::vector<double>{10, 20, 30, 40}));
    EXPECT_EQ(s.view.light, 0);
}

TEST(LightList, AddedLightsAreApartFromAllOthers) {
    Settings s;
    s.light_count = 1;
    for (int i = 0; i < 5; ++i) {
        s.view.light = 0;
        add_light(s);
    }
    for (int a = 0; a < s.light_count; ++a)
        for (int b = 0; b < a; ++b)
            EXPECT_GE(
                std::abs(std::remainder(s.lights[std::size_t(a)].azimuth - s.lights[std::size_t(b)].azimuth, 360)), 30)
                << a << " and " << b;
}

TEST(LightList, SoloTogglesTheOtherLights) {
    Settings s = with_lights(3);
    const Settings all = s;
    solo_light(s, 1);
    EXPECT_TRUE(is_solo(s, 1));
    EXPECT_FALSE(s.lights[0].on || s.lights[2].on);
    solo_light(s, 2);
    EXPECT_TRUE(is_solo(s, 2));
    solo_light(s, 2);
    EXPECT_EQ(s, all);
    solo_light(s, 3);
    EXPECT_EQ(s, all) << "there is no such light";
}

constexpr int kF2 = 291;

/// Returns the ID of a widget in a light's line, below the window's ID.
auto in_line(int light, const char* label, const char* within = nullptr) {
    return [=](ImGuiID id) {
        id = ImHashStr("lights", 0, ImHashStr("light", 0, id));  // the table
        id = ImHashData(&light, sizeof light, id);
        return ImHashStr(label, 0, within ? ImHashStr(within, 0, id) : id);
    };
}

class LightTable : public testing::Test {
protected:
    LightTable() {
        ui.state.settings.light_count = 3;
        ui.state.settings_panel.search = "intensity";  // the group alone
        ui.frames(2);
    }
    void click(const std::function<unsigned(unsigned)>& id) { ui.click(ui.find("rows", id)); }
    void key(int code) {
        ui.key(code);
        ui.frames(2);
    }
    const LightSettings& light(int i) const { return ui.state.settings.lights[std::size_t(i)]; }
    UiHarness ui{700, 600};
};

TEST_F(LightTable, SelectsSwitchesAndSolosLights) {
    click(in_line(2, "2 Directional###shown"));
    EXPECT_EQ(ui.state.settings.view.light, 2);
    click(in_line(1, "##on"));
    EXPECT_FALSE(light(1).on);
    click(in_line(0, "Solo"));
    EXPECT_TRUE(is_solo(ui.state.settings, 0));
    click(in_line(0, "Solo"));
    EXPECT_TRUE(light(0).on && light(1).on && light(2).on);
    ui.state.history.undo();
    EXPECT_TRUE(ui.state.history.can_undo()) << "each click is a step";
}

TEST_F(LightTable, EveryButtonFitsANarrowWindow) {
    ui.state.settings.view.light = 0;
    ui.state.settings.lights[0].name = "key";
    const auto at = ui.find("rows", [](ImGuiID seed) { return ImHashStr(">", 0, ImHashStr("light", 0, seed)); });
    ASSERT_TRUE(at) << "cut away";
    ui.click(*at);
    EXPECT_EQ(light(1).name, "key");
}

TEST_F(LightTable, ButtonsStayUnderTheMouse) {
    const auto add = [&] {
        return ui.find("rows", [](ImGuiID seed) { return ImHashStr("Add light", 0, ImHashStr("light", 0, seed)); });
    };
    const auto at = add();
    ASSERT_TRUE(at);
    for (int lights = 4; lights <= 6; ++lights) {
        ui.click(*at);
        ui.frames(2);
        EXPECT_EQ(ui.state.settings.light_count, lights);
        EXPECT_EQ(add(), at);
    }
}

TEST_F(LightTable, F2RenamesTheShownLight) {
    ui.state.settings.view.light = 1;
    ui.frames(2);
    key(kF2);
    ui.type("key");
    key(ImGui::GetKeyIndex(ImGuiKey_Enter));
    EXPECT_EQ(light(1).name, "key");
    EXPECT_NE(ui.printed().find(U"1key"), std::u32string::npos) << "in the place of its type";
    EXPECT_EQ(ui.state.history.undo().lights[1].name, "") << "one step";
    // Typed text replaces the old name; Escape discards it.
    key(kF2);
    ui.type("fill");
    key(ImGui::GetKeyIndex(ImGuiKey_Escape));
    EXPECT_EQ(light(1).name, "key");
    EXPECT_FALSE(ui.state.lights.rename);
    key(kF2);
    ui.type(std::string(61, 'n'));
    key(ImGui::GetKeyIndex(ImGuiKey_Enter));
    EXPECT_EQ(light(1).name, "key") << "that one is too long";
    EXPECT_EQ(ui.state.log.lines().back().kind, LogKind::Error);
}

TEST_F(LightTable, DoubleClickRenamesALightAndAClickElsewhereConfirms) {
    const auto at = ui.find("rows", in_line(2, "###shown"));
    ASSERT_TRUE(at);
    ui.click(*at);
    ui.click(*at);
    ASSERT_TRUE(ui.state.lights.rename);
    ui.frames(2);
    ui.type("rim");
    click(in_line(0, "##on"));
    EXPECT_EQ(light(2).name, "rim");
    EXPECT_FALSE(ui.state.lights.rename);
}

TEST_F(LightTable, SwatchOpensAColourPicker) {
    click(in_line(1, "##ColorButton", "##colour"));
    EXPECT_TRUE(ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup));
    const auto square = ui.find("##Popup", [](ImGuiID id) { return ImHashStr("sv", 0, ImHashStr("##picker", 0, id)); });
    ASSERT_TRUE(square);
    ui.click(*square);  // near its corner: white, saturation 0
    const glm::vec2 far = *square + glm::vec2(60, 60);
    ui.click(far);
    EXPECT_LT(light(1).green, 0.9);
    EXPECT_EQ(light(0).green, 1);
}

TEST_F(LightTable, CubeCrossSelectsAFace) {
    ui.state.settings.lights[0].type = LightType::Point;
    ui.move({0, 0});  // no tooltip, which names a face, too
    ui.frames(2);
    const auto at = [&](std::u32string_view mark) {
        ImVec2 last(0, 0);  // before it the map viewer names the face shown
        for (int which = 0; const auto found = ui.drawn().find(mark, which); ++which) last = *found;
        return last;
    };
    const ImVec2 front = at(U"+z");
    EXPECT_LT(at(U"-x").x, front.x) << "as a cube unfolds";
    EXPECT_LT(front.x, at(U"+x").x);
    EXPECT_LT(at(U"+x").x, at(U"-z").x);
    EXPECT_LT(at(U"+y").y, front.y);
    EXPECT_LT(front.y, at(U"-y").y);
    for (const auto& [mark, number] : {std::pair{U"-x", 1}, {U"+y", 2}, {U"-z", 5}}) {
        const ImVec2 letters = at(mark);
        ui.click({letters.x + 3, letters.y + 3});
        EXPECT_EQ(ui.state.settings.view.face, number);
        ui.move({0, 0});
        ui.frames(2);
    }
    ui.state.settings.lights[0].type = LightType::Spot;
    ui.frames(2);
    EXPECT_FALSE(ui.drawn().find(U"-y", 0)) << "one map has no faces";
}

TEST(LightList, ComparisonsNameTheLight) {
    UiHarness ui(1280, 900);
    ui.state.settings.light_count = 2;
    ui.state.settings.lights[1].name = "key";
    ComparisonFacts other{.with = ui.state.compare, .settings = ui.state.settings};
    other.settings.lights[1].azimuth += 10;
    ui.comparison = other;
    ui.state.window.open_page = Page::Compare;
    ui.frames(4);
    EXPECT_TRUE(ui.drawn().shows("Light 1 (key)"));
}

TEST(LightList, EachChangeIsOneUndoStep) {
    UiHarness ui(1280, 900);
    ui.frames(3);
    const Settings one = ui.state.settings;
    const auto step = [&](auto change) {
        change(ui.state.settings);
        ui.frames(2);
        return ui.state.settings;
    };
    const Settings two = step([](Settings& s) { add_light(s); });
    EXPECT_EQ(two.light_count, one.light_count + 1);
    EXPECT_NE(two.lights[1].azimuth, two.lights[0].azimuth) << "another side";
    const Settings three = step([](Settings& s) { copy_light(s, 1); });
    step([](Settings& s) { delete_light(s, 0); });
    EXPECT_EQ(ui.state.history.undo(), three);
    EXPECT_EQ(ui.state.history.undo(), two);
    EXPECT_EQ(ui.state.history.undo(), one);
}

}  // namespace
}  // namespace si::test
