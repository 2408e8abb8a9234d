// Tests of the window's layout: the scene is largest, and nothing moves by itself.
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <set>

#include "renderer/settings/overlays.h"
#include "renderer/settings/param.h"
#include "tests/support/traits.h"
#include "tests/ui/ui_harness.h"
#include "ui/widgets/overlay_widget.h"
#include "ui/widgets/theme.h"

namespace si::test {
namespace {

double scene_share(const UiHarness& ui) {
    const PictureView& v = *ui.state.viewport.view;
    return v.size.x * v.size.y / (double(ui.width()) * ui.height());
}

struct Shown : UiHarness {
    Shown(int width, int height, float scale = 1) : UiHarness(width, height, scale) {
        state.layout = {};
        frames(3);
    }
    /// Returns the window of a part of the editor, or null. No other window's name begins like it.
    ImGuiWindow* part(const std::string& name) { return window("editor/" + name + "_"); }
};

TEST(Layout, SceneHasHalfOfTheWindowAtFirst) {
    EXPECT_GE(scene_share(Shown(1600, 900)), 0.5);
    EXPECT_GE(scene_share(Shown(1920, 1080)), 0.5);
    EXPECT_GE(scene_share(Shown(3840, 2160, 2)), 0.5);
    EXPECT_GE(scene_share(Shown(1280, 720)), 0.4);
}

TEST(Layout, PictureKeepsItsPlaceForEveryChoice) {
    for (const int width : {640, 900, 1280, 1600}) {
        Shown ui(width, width * 9 / 16);
        const glm::dvec2 origin = ui.state.viewport.view->origin, size = ui.state.viewport.view->size;
        const auto unmoved = [&](const char* what) {
            ui.frames(3);
            EXPECT_EQ(ui.state.viewport.view->origin, origin) << what << " at " << width;
            EXPECT_EQ(ui.state.viewport.view->size, size) << what << " at " << width;
        };
        ui.state.settings.view.overlay = 5;
        unmoved("an overlay");
        ui.state.settings.view.overlay_range = OverlayRange::Manual;
        unmoved("its scale");
        ui.state.settings.light_count = 3;
        unmoved("three lights");
        ui.state.comparison.view = ComparisonView::Swipe;
        unmoved("a comparison");
        ui.state.comparison.view = ComparisonView::Off;
        set_setting(ui.state.settings, "filter.kernel", "evsm4");
        unmoved("moments in the map");
        ui.state.log.add(LogKind::Error, "Something long that has happened to be said, " + std::string(300, 'x'));
        unmoved("a message");
    }
}

TEST(Layout, HiddenPartsKeepNothingAwake) {
    // A requested tab waits until tabs are shown.
    Shown ui(1280, 720);
    ui.state.window.open_page = Page::Effects;
    ui.frames(3);
    ui.state.window.maximised = si::Panel::Scene;
    ui.state.window.open_page = Page::Error;
    ui.frames(3);
    const EditorRequests alone = ui.frame();
    EXPECT_FALSE(alone.redraw);
    EXPECT_TRUE(alone.at_rest);
    EXPECT_FALSE(alone.want_timing) << "of the tab below";
    ui.state.window.maximised.reset();
    ui.frames(3);
    EXPECT_TRUE(ui.state.shows(Page::Error));
    EXPECT_TRUE(ui.frame().want_error);
    EXPECT_FALSE(ui.frame().redraw);
    EXPECT_FALSE(ui.state.window.open_page);
    ui.state.window.maximised = si::Panel::Map;
    EXPECT_FALSE(ui.frame().want_error);
}

TEST(Layout, KeyMaximisesAndRestoresAPanel) {
    Shown ui(1280, 720);
    ui.move({300, 300});
    ui.frames(2);
    ui.key(300);
    EXPECT_EQ(ui.state.window.maximised, si::Panel::Scene);
    EXPECT_GE(scene_share(ui), 0.88);
    EXPECT_FALSE(ui.frame().want_map) << "what is hidden costs nothing";
    EXPECT_FALSE(ui.part("inspector"));
    ui.key(ImGui::GetKeyIndex(ImGuiKey_Escape));
    EXPECT_FALSE(ui.state.window.maximised);
    ASSERT_TRUE(ui.part("inspector"));
    const ImGuiWindow* map = ui.part("map");
    ASSERT_TRUE(map);
    ui.move({map->Pos.x + 100, map->Pos.y + 100});
    ui.frames(2);
    ui.key(300);
    EXPECT_EQ(ui.state.window.maximised, si::Panel::Map);
    EXPECT_TRUE(ui.frame().want_map);
    ui.key(300);
    EXPECT_FALSE(ui.state.window.maximised);
}

TEST(Layout, DoubleClickOnATitleMaximisesAndRestores) {
    Shown ui(1280, 720);
    const auto double_click = [&](glm::vec2 at) {
        ui.frames(30);  // earlier clicks no longer count
        ui.click(at);
        ui.click(at);
        ui.frames(2);
    };
    const auto title = [&] {
        const ImGuiWindow* map = ui.part("map");
        const ImVec2 gap = ImGui::GetStyle().WindowPadding;
        return glm::vec2(map->Pos.x + gap.x + 8, map->Pos.y + gap.y + 11);
    };
    double_click(title());
    EXPECT_EQ(ui.state.window.maximised, si::Panel::Map);
    double_click(title());
    EXPECT_FALSE(ui.state.window.maximised);

    const auto bar = [&]() -> const ImGuiTabBar& {
        ImGuiContext& g = *ImGui::GetCurrentContext();
        return *g.TabBars.GetByKey(ui.part("bottom")->GetID("bottom"));
    };
    const auto tab = [&](int which) {
        const ImGuiTabItem& item = bar().Tabs[which];
        return glm::vec2(bar().BarRect.Min.x + item.Offset + item.Width / 2, bar().BarRect.GetCenter().y);
    };
    const auto right_of_tabs = [&] {
        return glm::vec2(bar().BarRect.Min.x + bar().WidthAllTabs + 15, bar().BarRect.GetCenter().y);
    };
    double_click(tab(4));
    EXPECT_EQ(ui.state.window.maximised, si::Panel::Strip);
    EXPECT_TRUE(ui.state.shows(Page::Log));
    double_click(right_of_tabs());
    EXPECT_FALSE(ui.state.window.maximised);
    double_click(right_of_tabs());
    EXPECT_EQ(ui.state.window.maximised, si::Panel::Strip);
    EXPECT_TRUE(ui.state.shows(Page::Log));
    double_click(tab(4));
    EXPECT_FALSE(ui.state.window.maximised);
    double_click(tab(4) - glm::vec2(0, 60));
    EXPECT_FALSE(ui.state.window.maximised) << "above the tabs";
    ui.frames(30);
    ui.click(tab(1));
    ui.click(tab(2));
    EXPECT_FALSE(ui.state.window.maximised) << "two tabs, a click each";
}

TEST(Layout, SettingsHaveAThirdOfANarrowWindow) {
    for (const auto& [w, h] : {std::pair{640, 480}, {900, 600}}) {
        Shown ui(w, h);
        ASSERT_TRUE(ui.part("inspector"));
        EXPECT_LE(ui.part("inspector")->Size.x, std::max(float(w) / 3, 14 * 15.0f) + 1) << w;
        EXPECT_GE(ui.part("bottom")->Size.x, 0.6f * float(w)) << w;
        ui.state.layout.settings_width = 60;
        ui.frames(2);
        EXPECT_LE(ui.part("inspector")->Size.x, float(w) / 3 + 1) << "nor by dragging, at " << w;
    }
    Shown ui(1600, 900);
    EXPECT_EQ(ui.part("inspector")->Size.x, 24 * 15);
    ui.state.layout.settings_width = 60;
    ui.frames(2);
    EXPECT_EQ(ui.part("inspector")->Size.x, 800) << "half of a wide one";
}

TEST(Layout, MapKeepsItsChosenPlace) {
    Shown ui(1280, 720);
    const double above = scene_share(ui);
    ui.state.layout.map_place = MapSpot::NextToScene;
    EXPECT_TRUE(ui.frames(3).want_map);
    EXPECT_LT(scene_share(ui), above);
    ui.state.layout.map_place = MapSpot::Inset;
    EXPECT_TRUE(ui.frames(3).want_map);
    EXPECT_EQ(scene_share(ui), above);
    const ImGuiWindow* map = ui.part("map");
    ASSERT_TRUE(map);
    const PictureView& scene = *ui.state.viewport.view;
    EXPECT_GE(map->Pos.x, scene.origin.x);
    EXPECT_LE(map->Pos.y + map->Size.y, scene.origin.y + scene.size.y);
    ui.state.layout.map_place = MapSpot::Hidden;
    EXPECT_FALSE(ui.frames(3).want_map);
    EXPECT_FALSE(ui.part("map"));
    ui.key('N');
    EXPECT_EQ(ui.state.layout.map_place, MapSpot::AboveSettings);
}

TEST(Layout, DoubleClickResetsASplitter) {
    Shown ui(1280, 720);
    const ImGuiWindow* settings = ui.part("inspector");
    ASSERT_TRUE(settings);
    const glm::vec2 at(settings->Pos.x - 2, settings->Pos.y + 100);
    ui.drag(at, at - glm::vec2(80, 0));
    EXPECT_GT(ui.state.layout.settings_width, EditorLayout{}.settings_width + 3);
    ui.click(at - glm::vec2(80, 0));
    ui.click(at - glm::vec2(80, 0));
    ui.frames(2);
    EXPECT_EQ(ui.state.layout.settings_width, EditorLayout{}.settings_width);
}

SI_TEST_IS(Later, Layout, ControlsWithoutRoomMoveToTheMenuOfTheRow);
TEST(Layout, ControlsWithoutRoomMoveToTheMenuOfTheRow) {
    Shown ui(900, 600);
    EXPECT_FALSE(ui.find("editor/scene", "view.frustum", "##value"));
    ui.click(ui.find("editor/scene", "scene tools", "»"));
    EXPECT_TRUE(ui.find("##Popup", "view.frustum", "##value"));
}

TEST(Layout, SceneToolsKeepTheirPlacesForEveryChoice) {
    Shown ui(1600, 900);
    const auto places = [&] {
        std::vector<glm::vec2> at;
        for (const auto& [group, label] : {std::pair{"view.overlay", "##value"},
                                           {"", "##against view"},
                                           {"", "##against what"},
                                           {"", "Through light"},
                                           {"", "Freeze view"},
                                           {"view.frustum", "##value"}}) {
            const auto found = ui.find("editor/scene", group, label);
            EXPECT_TRUE(found) << group << label;
            at.push_back(found.value_or(glm::vec2(-1)));
        }
        return at;
    };
    const auto before = places();
    ui.state.settings.view.panes = Panes::Four;
    ui.frames(3);
    EXPECT_EQ(places(), before) << "several panes";
    ui.state.comparison.view = ComparisonView::Swipe;
    ui.frames(3);
    EXPECT_EQ(places(), before) << "a comparison";
}

TEST(Layout, ChoosingTheOtherSideStartsAComparison) {
    Shown ui(1600, 900);
    ui.click(ui.find("editor/scene", "", "##against what"));
    ui.click(ui.find("##Combo", "", "the program's defaults"));
    EXPECT_EQ(ui.state.comparison.view, ComparisonView::Swipe);
    EXPECT_FALSE(ui.state.comparison.reference);
    EXPECT_EQ(ui.state.compare.kind, CompareKind::Defaults);
}

TEST(Layout, LegendInThePictureHasOpacityAndScale) {
    Shown ui(1280, 720);
    EXPECT_FALSE(ui.find("/legend_", "view.overlay_opacity", "##value")) << "nothing to turn";
    ui.state.settings.view.overlay = 4;
    ui.frames(3);
    const auto opacity = ui.find("/legend_", "view.overlay_opacity", "##value");
    ASSERT_TRUE(opacity);
    EXPECT_TRUE(ui.find("/legend_", "view.overlay_range", "##value"));
    EXPECT_FALSE(ui.find("/legend_", "view.overlay_min", "##value"));
    ui.drag(*opacity, *opacity + glm::vec2(25, 0));
    EXPECT_LT(ui.state.settings.view.overlay_opacity, 0.9);
    EXPECT_GT(ui.state.settings.view.overlay_opacity, 0.0);
    EXPECT_FALSE(ui.state.probe_pixel) << "the picture below is not clicked";
    ui.state.settings.view.overlay_range = OverlayRange::Manual;
    ui.frames(3);
    EXPECT_TRUE(ui.find("/legend_", "view.overlay_min", "##value"));
    ui.state.settings.view.overlay = 15;  // normals: colours without a scale
    ui.frames(3);
    EXPECT_TRUE(ui.find("/legend_", "view.overlay_opacity", "##value"));
    EXPECT_FALSE(ui.find("/legend_", "view.overlay_range", "##value"));
}

SI_TEST_IS(Later, Layout, EveryOverlayHasAKeyOfItsOwn);
TEST(Layout, EveryOverlayHasAKeyOfItsOwn) {
    std::set<std::string> keys;
    for (int number = 0; number <= int(overlays().size()); ++number) {
        const std::string key = overlay_key(number);
        EXPECT_FALSE(key.empty()) << number;
        EXPECT_TRUE(keys.insert(key).second) << key;
        if (number == 0) continue;
        Shown ui(1280, 720);
        ImGuiIO& io = ImGui::GetIO();
        io.KeyShift = key.starts_with("Shift");
        io.KeyAlt = key.find("Alt") != std::string::npos;
        ui.key(key.back());
        EXPECT_EQ(ui.state.settings.view.overlay, number) << key;
        ui.key(key.back());
        EXPECT_EQ(ui.state.settings.view.overlay, 0) << key << " again";
    }
    EXPECT_EQ(overlay_of_digit(3, {.ctrl = true}), 0);
    EXPECT_EQ(overlay_of_digit(9, {.shift = true, .alt = true}), overlays().size() >= 36 ? 36 : 0);
}

TEST(Layout, DigitSelectsTheOverlayOfThePaneUnderTheMouse) {
    Shown ui(1600, 900);
    ui.state.settings.view.panes = Panes::Four;
    ui.frames(3);
    const glm::dvec2 origin = ui.state.viewport.view->origin, size = ui.state.viewport.view->size;
    ui.move(glm::vec2(origin + 1.5 * size));
    ui.frames(2);
    ui.key('2');
    EXPECT_EQ(ui.state.settings.view.overlay, 0);
    EXPECT_EQ(ui.state.settings.view.overlay_4, 2);
    ui.state.comparison.view = ComparisonView::Swipe;
    ui.frames(2);
    ui.key('3');
    EXPECT_EQ(ui.state.settings.view.overlay, 3) << "compared, the picture is one pane";
}

TEST(Layout, AllOverlaysAreVisibleInASmallWindow) {
    Shown ui(1280, 720);
    ui.click(ui.find("editor/scene", "view.overlay", "##value"));
    ui.frames(2);
    for (const Overlay& overlay : overlays())
        if (std::ranges::all_of(overlay.label, [](char c) { return c > 0; })) {
            EXPECT_TRUE(ui.drawn().shows(std::string(overlay.label))) << overlay.label;
        }
    EXPECT_TRUE(ui.drawn().shows("Shift+1"));
    const ImGuiWindow* list = ImGui::GetCurrentContext()->OpenPopupStack.back().Window;
    EXPECT_EQ(list->ScrollMax.y, 0);
    EXPECT_LE(list->Pos.y + list->Size.y, 720);
}

/// Returns the middle of a tab in the inspector or the strip.
glm::vec2 tab_place(Shown& ui, Tab tab) {
    const bool inspector = is_in_inspector(tab);
    const char* const id = inspector ? "inspector" : "bottom";
    const ImGuiTabBar& bar = *ImGui::GetCurrentContext()->TabBars.GetByKey(ui.part(id)->GetID(id));
    const ImGuiTabItem& item = bar.Tabs[index_of(tab) - (inspector ? 0 : index_of(Tab::Error))];
    return {bar.BarRect.Min.x + item.Offset + item.Width / 2, bar.BarRect.GetCenter().y};
}

TEST(Layout, TabsMoveNeitherThePictureNorEachOther) {
    Shown ui(1600, 900);
    const EditorRequests first = ui.frame();
    const glm::dvec2 origin = ui.state.viewport.view->origin, size = ui.state.viewport.view->size;
    EXPECT_FALSE(ui.state.strip_page) << "closed at first";
    std::array<glm::vec2, kTabs> places{};
    for (int i = 0; i < kTabs; ++i) places[std::size_t(i)] = tab_place(ui, Tab(i));
    for (int i = 0; i < kTabs; ++i) {
        ui.click(places[std::size_t(i)]);
        const EditorRequests now = ui.frames(3);
        EXPECT_TRUE(ui.state.shows(first_pages()[std::size_t(i)])) << kTabLabels[i];
        EXPECT_EQ(ui.state.viewport.view->origin, origin) << kTabLabels[i];
        EXPECT_EQ(ui.state.viewport.view->size, size) << kTabLabels[i];
        EXPECT_EQ(now.scene_height, first.scene_height) << kTabLabels[i];
        for (int other = 0; other < kTabs; ++other)
            EXPECT_EQ(tab_place(ui, Tab(other)), places[std::size_t(other)])
                << kTabLabels[other] << " after " << kTabLabels[i];
    }
    EXPECT_NEAR(ui.part("bottom")->Size.y, 15 * 15, 1);
    ui.state.layout.bottom_height = 10;
    ui.frames(2);
    EXPECT_NEAR(ui.part("bottom")->Size.y, 150, 1) << "dragged by hand";
    EXPECT_EQ(ui.state.viewport.view->size, size);
    ui.frames(30);
    ui.click(places[std::size_t(index_of(Tab::Log))]);
    ui.frames(3);
    EXPECT_FALSE(ui.state.strip_page) << "the tab in front closes the strip";
    ui.frames(30);
    ui.click(places[std::size_t(index_of(Tab::Log))]);
    ui.frames(3);
    EXPECT_TRUE(ui.state.shows(Page::Log));
    ui.click(ui.find("editor/bottom", "", "\u00d7"));
    ui.frames(3);
    EXPECT_FALSE(ui.state.strip_page);
}

TEST(Layout, ClickedPixelIsShownBesideThePicture) {
    Shown ui(1280, 720);
    const glm::dvec2 origin = ui.state.viewport.view->origin, size = ui.state.viewport.view->size;
    ui.click(glm::vec2(origin + 0.5 * size));
    ui.frames(3);
    EXPECT_TRUE(ui.state.shows(Page::Pixel));
    EXPECT_FALSE(ui.state.strip_page);
    EXPECT_EQ(ui.state.viewport.view->origin, origin);
    EXPECT_EQ(ui.state.viewport.view->size, size);
    EXPECT_TRUE(ui.prints("Numbers"));
    EXPECT_FALSE(ui.prints("light clip space")) << "folded";
    // While Improve puts this pixel right, another pixel is another task of the same panel.
    open_improve(ui.state, ImproveMode::Pixel);
    ui.frames(3);
    ui.click(glm::vec2(origin + 0.4 * size));
    ui.frames(3);
    EXPECT_TRUE(ui.state.shows(Page::Improve));
}

SI_TEST_IS(Later, Layout, TabWithSeveralPagesHasAButtonForEach);
TEST(Layout, TabWithSeveralPagesHasAButtonForEach) {
    for (const int width : {800, 1280, 2560}) {
        Shown ui(width, 720);
        for (const auto& [tab, buttons] : {std::pair{Tab::Cost, std::pair{Page::Frontier, Page::Effects}},
                                           {Tab::Cost, std::pair{Page::Frontier, Page::LightPath}},
                                           {Tab::Compare, std::pair{Page::Compare, Page::Imported}},
                                           {Tab::Lab, std::pair{Page::Lab, Page::Numbers}}}) {
            ui.state.window.open_page = buttons.first;
            ui.frames(4);
            for (const Page page : {buttons.second, buttons.first}) {
                const char* const label = kPageTable[index_of(page)].label;
                ui.click(ui.find("editor/bottom", "", label));
                ui.frames(3);
                EXPECT_TRUE(ui.state.shows(page)) << label << " at " << width;
                EXPECT_EQ(ui.state.window.strip_tab, tab);
            }
        }
    }
}

TEST(Layout, SecondPressOnAButtonBesideTabsMaximisesNothing) {
    Shown ui(1280, 720);
    ui.state.window.open_page = Page::Frontier;
    ui.frames(4);
    for (const char* label : {"Frontier", "Light path", "Effects", "\u00d7"}) {
        const auto at = ui.find("editor/bottom", "", label);
        ASSERT_TRUE(at) << label;
        ui.frames(30);
        ui.click(*at);
        ui.click(*at);
        ui.frames(2);
        EXPECT_FALSE(ui.state.window.maximised) << label;
    }
    EXPECT_FALSE(ui.state.layout.strip_open);
}

TEST(Layout, NoTabOfAClosedStripLooksSelected) {
    Shown ui(1280, 720);
    const auto selected = [&] {
        const ImGuiTabBar& bar = *ImGui::GetCurrentContext()->TabBars.GetByKey(ui.part("bottom")->GetID("bottom"));
        const ImU32 colour = ImGui::GetColorU32(ImGui::GetStyle().Colors[ImGuiCol_TabActive]);
        // The line below the tabs has the same colour.
        return std::ranges::count_if(ui.part("bottom")->DrawList->VtxBuffer, [&](const ImDrawVert& v) {
            return v.col == colour && v.pos.y >= bar.BarRect.Min.y - 1 && v.pos.y < bar.BarRect.GetCenter().y;
        });
    };
    EXPECT_EQ(selected(), 0);
    ui.state.layout.strip_open = true;
    ui.frames(3);
    EXPECT_GT(selected(), 0);
}

/// Every tab is readable in full at every size and in both themes.
TEST(Layout, AllTabsAreThereAtEverySize) {
    for (const auto& [w, h, scale] :
         {std::tuple{800, 600, 1.0f}, {1280, 720, 1.0f}, {1600, 900, 1.0f}, {2560, 1440, 1.0f}, {2560, 1440, 2.0f}})
        for (const bool light : {false, true}) {
            Shown ui(w, h, scale);
            ui.state.layout.light_theme = light;
            for (int i = 0; i < kPages; ++i) {
                ui.state.window.open_page = Page(i);
                ui.frames(4);
                EXPECT_TRUE(ui.state.shows(Page(i))) << i << " at " << w;
                const ImGuiWindow* const strip = ui.part("bottom");
                ASSERT_TRUE(strip);
                EXPECT_LE(strip->Pos.y + strip->Size.y, float(h)) << w;
                EXPECT_GE(ui.state.viewport.view->size.y - ui.state.viewport.covered, 10 * 15 * scale - 40) << w;
            }
            ui.frames(2);
            for (const char* label : kTabLabels)
                EXPECT_TRUE(ui.drawn().shows(label)) << label << " at " << w << " x " << h;
        }
}

TEST(Layout, ShownSettingsAreBInEveryComparison) {
    Shown ui(1600, 900);
    ui.picture_comparison = PictureComparisonFacts{};
    ui.picture_comparison->picture.texture = 1;
    ui.state.pinned = PinnedSettings{ui.state.settings, ui.state.scene_name};
    for (const ComparisonView view : {ComparisonView::Swipe, ComparisonView::SideBySide})
        for (const CompareKind kind : {CompareKind::Scene, CompareKind::Defaults, CompareKind::Pinned}) {
            for (const bool reference : {false, true}) {
                ui.state.comparison = {.view = view, .reference = reference};
                ui.state.compare = {kind, {}};
                ui.frames(3);
                EXPECT_EQ(ui.lacking({"B: shown settings", "A: "}), "") << int(view) << int(kind) << reference;
                const auto a = ui.drawn().find(U"A:"), b = ui.drawn().find(U"B:shown");
                ASSERT_TRUE(a && b);
                EXPECT_LT(b->x, a->x) << "B is on the left";
            }
        }
}

TEST(Layout, FourPanesOpenWithFourOverlays) {
    Shown ui(1600, 900);
    ui.click(ui.find("editor/scene", "view.panes", "##value"));
    ui.frames(2);
    const auto choices = find_setting("view.panes")->param->choices();
    const auto four = std::ranges::find(choices, "four", &Choice::key);
    ASSERT_NE(four, choices.end());
    ui.click(ui.find_choice(int(four - choices.begin()), std::string(four->label)));
    ui.frames(2);
    EXPECT_EQ(ui.state.settings.view.panes, Panes::Four);
    std::set<int> shown;
    for (std::size_t pane = 0; pane < 4; ++pane) shown.insert(overlay_of_pane(ui.state.settings.view, pane));
    EXPECT_EQ(shown.size(), 4u) << "each shows something else";
}

TEST(Layout, StatusBarForgetsMessagesButNoProblems) {
    Shown ui(1280, 720);
    const auto wait = [&](double seconds) {
        ui.frame_seconds = seconds;
        ui.frame();
        ui.frame_seconds = 1.0 / 60;
        ui.frame();
    };
    ui.state.log.add(LogKind::Info, "Wrote somewhere.json");
    ui.frame();
    wait(15);
    EXPECT_TRUE(ui.prints("Wrote somewhere.json"));
    wait(10);
    EXPECT_FALSE(ui.prints("Wrote somewhere.json"));
    ui.state.log.add(LogKind::Info, "Wrote somewhere.json");
    ui.frame();
    EXPECT_TRUE(ui.prints("Wrote somewhere.json")) << "again";
    ui.state.log.add(LogKind::Warning, "Something is odd");
    ui.frame();
    wait(60);
    EXPECT_TRUE(ui.prints("Something is odd"));
}

TEST(Layout, SecondMenuOpensAtOnce) {
    Shown ui(1280, 720);
    const auto open = [&](const char* popup) {
        ImGuiContext& g = *ImGui::GetCurrentContext();
        const ImGuiID id = ui.part("top")->GetID(popup);
        return g.OpenPopupStack.Size == 1 && g.OpenPopupStack[0].PopupId == id;
    };
    const auto file = ui.find("editor/top", "", "File"), steps = ui.find("editor/top", "", "History");
    ASSERT_TRUE(file && steps);
    ui.click(*file);
    EXPECT_TRUE(open("file"));
    ui.click(*steps);
    EXPECT_TRUE(open("steps"));
    ui.click(*file);
    EXPECT_TRUE(open("file"));
}

TEST(Layout, ControlsWithoutRoomInTheTopBarMoveToAMenu) {
    Shown ui(640, 400);
    EXPECT_TRUE(ui.find("editor/top", "", "Help"));
    EXPECT_TRUE(ui.find("editor/top", "", "View"));
    EXPECT_FALSE(ui.find("editor/top", "", "Save"));
    ui.click(ui.find("editor/top", "top bar", "»"));
    for (const char* label : {"Undo", "History", "Settings diff", "Save"})
        EXPECT_TRUE(ui.find("##Popup", "", label)) << label;
    const auto save = ui.find("##Popup", "", "Save");
    ASSERT_TRUE(save);
    ui.move(*save);
    ui.frames(2);
    EXPECT_TRUE(ui.click_here().save_preset);
}

TEST(Layout, OnlyAWindowBelowItsMinimumSizeScrolls) {
    const auto scroll_range = [](int width, int height) {
        const Shown ui(width, height);
        const ImGuiWindow* window = ImGui::FindWindowByName("editor");
        return window ? glm::vec2(window->ScrollMax.x, window->ScrollMax.y) : glm::vec2(-1);
    };
    const glm::vec2 small = scroll_range(400, 300);
    EXPECT_GE(small.x, kMinWindowWidth - 400);
    EXPECT_GE(small.y, kMinWindowHeight - 300);
    EXPECT_EQ(scroll_range(int(kMinWindowWidth), int(kMinWindowHeight)), glm::vec2(0));
}

/// Frequent settings must be visible without a search.
TEST(Layout, FrequentSettingsNeedNoScrolling) {
    for (const auto& [w, h, scale] : {std::tuple{1280, 720, 1.0f}, {1600, 900, 1.0f}, {2560, 1440, 2.0f}}) {
        Shown ui(w, h, scale);
        for (const char* label : {"Kind", "Normal offset", "Auto bias", "Kernel", "Resolution"})
            EXPECT_TRUE(ui.drawn().shows(label)) << label << " at " << w << " x " << h;
        const ImGuiWindow* map = ui.part("map");
        ASSERT_TRUE(map);
        EXPECT_GE(map->Size.y, 0.4f * float(h)) << "the map has to be looked at, too";
    }
}

TEST(Layout, DraggedMapKeepsItsPlace) {
    Shown ui(1280, 720);
    const float first = ui.part("map")->Size.y;
    ui.state.layout.map_height = 0.7f;
    ui.frames(2);
    EXPECT_GT(ui.part("map")->Size.y, first + 80);
}

TEST(Layout, SettingsFillTheSpaceBesideTheSquareMap) {
    for (const bool plots : {true, false}) {
        UiHarness ui(1600, 2160);
        ui.state.layout.map_plots = plots;
        ui.state.layout.map_place = MapSpot::AboveSettings;
        ui.frames(3);
        const ScreenRect map = ui.state.shots.map_rect;
        EXPECT_GT(map.size.y, 0.95f * map.size.x) << plots;
        EXPECT_LT(map.size.y, 1.1f * map.size.x) << plots;
    }
}

TEST(Layout, RareSettingsAreOneClickAway) {
    Shown ui(1280, 1400);
    const auto shows = [&](const char* label) {
        ui.frames(2);
        return ui.drawn().shows(label);
    };
    for (const char* label : {"Polygon offset factor", "Addressing", "Method"}) EXPECT_FALSE(shows(label)) << label;
    const auto more = [&](const char* group) {
        return ui.find("rows", [&](unsigned window) { return ImHashStr("###more", 0, ImHashStr(group, 0, window)); });
    };
    for (const auto& [group, label] : {std::pair{"bias", "Polygon offset factor"}, {"map", "Addressing"}}) {
        const auto at = more(group);
        ASSERT_TRUE(at) << group;
        ui.click(*at);
        ui.move({0, 0});
        EXPECT_TRUE(shows(label));
    }
    ui.click(*more("bias"));
    ui.move({0, 0});
    EXPECT_FALSE(shows("Polygon offset factor")) << "less again";
    ui.state.settings.bias.raster_slope = 2;
    EXPECT_TRUE(shows("Polygon offset factor")) << "what is changed is never hidden";
    EXPECT_FALSE(shows("Polygon offset units"));
    ui.state.settings_panel.search = "addressing";
    EXPECT_TRUE(shows("Addressing"));
    ui.state.settings_panel.search.clear();
    ui.state.settings.bias.raster_slope = 0;
    ui.state.settings_panel.only_changed = true;
    ui.state.settings.map.wrap = MapWrap::Clamp;
    EXPECT_TRUE(shows("Addressing"));
}

TEST(Layout, HelpIsShort) {
    for (const auto& [w, h, scale] :
         {std::tuple{640, 400, 1.0f}, {1280, 720, 1.0f}, {1600, 900, 1.0f}, {1920, 1080, 1.0f}, {3840, 2160, 2.0f}}) {
        SCOPED_TRACE(w);
        const bool scrolls = w == 640;  // one column
        Shown ui(w, h, scale);
        ui.state.window.show_shortcuts = true;
        ui.frames(4);
        const ImGuiWindow* help = ImGui::FindWindowByName("Mouse and keyboard");
        ASSERT_TRUE(help && help->WasActive);
        EXPECT_EQ(help->ScrollMax.y > 0, scrolls);
        EXPECT_EQ(help->ScrollMax.x, 0);
        EXPECT_GE(help->Pos.x, 0);
        EXPECT_GE(help->Pos.y, 0);
        EXPECT_LE(help->Pos.x + help->Size.x, float(w));
        EXPECT_LE(help->Pos.y + help->Size.y, float(h));
        EXPECT_TRUE(ui.drawn().shows("move the camera sideways"));
        for (const char* text :
             {"Middle drag, Shift+drag", "screenshot of the scene", "Double-click a splitter", "as wide as at first"})
            EXPECT_TRUE(scrolls || ui.drawn().shows(text)) << text;
    }
}

TEST(Layout, FirstPictureShowsItsProgress) {
    Shown ui(1280, 720);
    ui.with_facts = false;
    ui.frames(2);
    EXPECT_TRUE(ui.drawn().shows("No picture yet"));
    ui.drawing = DrawingFacts{"shadow map 0", 0.25};
    ui.frames(2);
    EXPECT_TRUE(ui.drawn().shows("for the first time: shadow map 0"));
    EXPECT_FALSE(ui.drawn().shows("No picture yet"));
    const auto filled = [&] {
        float right = 0;
        const ImDrawData& data = *ImGui::GetDrawData();
        for (int i = 0; i < data.CmdListsCount; ++i)
            for (const ImDrawVert& v : data.CmdLists[i]->VtxBuffer)
                if (v.col == theme::colours().done) right = std::max(right, v.pos.x);
        return right;
    };
    const float quarter = filled();
    ui.drawing->progress = 0.75;
    ui.frames(2);
    EXPECT_GT(filled(), quarter + 100);
}

TEST(Layout, ViewMenuChangesTheTheme) {
    Shown ui(1280, 720);
    const auto choose = [&](const char* item) {
        ui.click(ui.find("editor/top", "", "View"));
        ui.click(ui.find("##Popup", "", item));
        ui.frames(2);
    };
    const float dark = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg).x;
    choose("Light theme");
    EXPECT_TRUE(ui.state.layout.light_theme);
    EXPECT_GT(ImGui::GetStyleColorVec4(ImGuiCol_WindowBg).x, dark + 0.5f);
    choose("Dark theme");
    EXPECT_EQ(ImGui::GetStyleColorVec4(ImGuiCol_WindowBg).x, dark);
    ui.state.layout.settings_width += 5;
    choose("Reset layout");
    EXPECT_EQ(ui.state.layout.settings_width, EditorLayout{}.settings_width);
}

}  // namespace
}  // namespace si::test
