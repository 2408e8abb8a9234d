// Tests of zoom and pan in the map viewer by synthetic mouse, and of texel read-outs.
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "tests/support/traits.h"
#include "tests/ui/ui_harness.h"
#include "ui/map_view/map_marks.h"

namespace si::test {
namespace {

struct MapViewer {
    UiHarness ui;
    MapWindow& window = ui.state.map.window;
    glm::vec2 middle{0};

    explicit MapViewer(int width = 1280) : ui(width, 720) {
        ui.state.settings.map.resolution = 512;
        ui.state.layout.map_plots = false;
        ui.frames(3);
        const ImGuiWindow* w = UiHarness::window("editor/map_");
        middle = {w->Pos.x + 0.5f * w->Size.x, w->Pos.y + 0.5f * w->Size.y};
    }
    glm::ivec2 texel_at(glm::vec2 at) {
        ui.move(at);
        ui.frames(2);
        EXPECT_TRUE(ui.state.map.hovered_texel) << at.x << ", " << at.y;
        return ui.state.map.hovered_texel.value_or(glm::ivec2(-1));
    }
    void wheel(float steps) {
        ImGui::GetIO().MouseWheel = steps;
        ui.frames(2);
    }
};

TEST(MapWindow, TexelIndicesRiseToTheRightAndUp) {
    MapViewer m;
    const glm::ivec2 at = m.texel_at(m.middle), right = m.texel_at(m.middle + glm::vec2(60, 0)),
                     up = m.texel_at(m.middle - glm::vec2(0, 60));
    EXPECT_GT(right.x, at.x + 40);
    EXPECT_EQ(right.y, at.y);
    EXPECT_GT(up.y, at.y + 40);
    EXPECT_EQ(up.x, at.x);
}

TEST(MapWindow, WheelZoomsAboutTheMouseDownToSingleTexels) {
    MapViewer m;
    const glm::vec2 off = m.middle + glm::vec2(37, -52);
    const glm::ivec2 under = m.texel_at(off);
    EXPECT_FALSE(m.ui.frame().want_map_facts) << "the plots are closed";
    for (int i = 0; i < 60; ++i) m.wheel(1);
    EXPECT_EQ(m.texel_at(off), under);
    const glm::ivec2 neighbour = m.texel_at(off - glm::vec2(160, 0));
    EXPECT_EQ(neighbour, under - glm::ivec2(1, 0)) << "a texel is 160 pixels wide at most, and gets as wide";
    m.ui.move({5, 5});
    EXPECT_TRUE(m.ui.frames(2).want_map_values) << "numbers stand in the texels";
    m.ui.move(off);
    m.ui.frames(2);
    for (int i = 0; i < 80; ++i) m.wheel(-1);
    EXPECT_EQ(m.window.zoom, 1);
    EXPECT_EQ(m.window.centre, glm::vec2(0.5f));
}

TEST(MapWindow, DragPansAndDoubleClickShowsTheWholeMap) {
    MapViewer m;
    m.texel_at(m.middle);
    for (int i = 0; i < 12; ++i) m.wheel(1);
    const glm::vec2 from = m.middle, to = m.middle + glm::vec2(-45, 31);
    const glm::ivec2 taken = m.texel_at(from);
    m.ui.drag(from, to);
    const glm::ivec2 now = m.texel_at(to);
    EXPECT_LE(std::abs(now.x - taken.x), 1);
    EXPECT_LE(std::abs(now.y - taken.y), 1);
    EXPECT_NE(m.texel_at(from), taken);
    m.ui.click(to);
    m.ui.click(to);
    m.ui.frames(2);
    EXPECT_EQ(m.window.zoom, 1);
    EXPECT_EQ(m.window.centre, glm::vec2(0.5f));
}

TEST(MapWindow, PlotsAndLinksAreReadOnlyWhileShown) {
    MapViewer m;
    m.ui.move({5, 5});
    EXPECT_FALSE(m.ui.frames(2).want_links);
    m.texel_at(m.middle);
    EXPECT_TRUE(m.ui.frame().want_links);
    m.ui.state.layout.map_plots = true;
    EXPECT_TRUE(m.ui.frames(2).want_map_facts);
    EXPECT_FALSE(m.ui.frame().want_frozen_usage);
    m.ui.state.frozen = FrozenCamera{};
    EXPECT_TRUE(m.ui.frames(2).want_frozen_usage);
    m.ui.state.settings.view.map_source = MapSource::Camera;
    EXPECT_FALSE(m.ui.frames(2).want_frozen_usage) << "the map is not shown";
}

SI_TEST_IS(Later, MapWindow, CheckboxRequestsExactTexelsWhileTheMapIsShown);
TEST(MapWindow, CheckboxRequestsExactTexelsWhileTheMapIsShown) {
    MapViewer m(1400);
    m.ui.state.layout.settings_width = 14;
    m.ui.state.layout.map_share = 0.85f;  // its checkbox fits the row
    EXPECT_FALSE(m.ui.frames(2).want_exact_texels);
    const auto box = m.ui.find("editor/map", "", "Texels read");
    ASSERT_TRUE(box);
    m.ui.click(*box);
    EXPECT_TRUE(m.ui.state.map.exact_texels);
    EXPECT_TRUE(m.ui.frames(2).want_exact_texels);
    m.ui.move({100, 300});
    m.ui.press(true);
    m.ui.frame();
    m.ui.move({115, 315});
    EXPECT_FALSE(m.ui.frames(2).want_exact_texels) << "read back in every frame of a drag";
    m.ui.press(false);
    EXPECT_TRUE(m.ui.frames(2).want_exact_texels);
    m.ui.state.frozen = FrozenCamera{};
    EXPECT_FALSE(m.ui.frames(2).want_exact_texels) << "they are those of the camera that draws";
    m.ui.click(*box);
    EXPECT_TRUE(m.ui.state.map.exact_texels) << "it waits meanwhile";
    m.ui.state.frozen.reset();
    m.ui.state.settings.view.map_source = MapSource::Camera;
    EXPECT_FALSE(m.ui.frames(2).want_exact_texels);
    EXPECT_FALSE(m.ui.find("editor/map", "", "Texels read"));
    m.ui.state.settings.view.map_source = MapSource::Light;
    m.ui.frames(2);
    m.ui.click(*m.ui.find("editor/map", "", "Texels read"));
    EXPECT_FALSE(m.ui.frames(2).want_exact_texels);
}

TEST(MapWindow, LightIsSelectedByName) {
    MapViewer m;
    Settings& s = m.ui.state.settings;
    EXPECT_FALSE(m.ui.find("editor/map", "view.light", "##value")) << "one light is no choice";
    s.light_count = 3;
    s.lights[2].name = "Lamp";
    m.ui.frames(3);
    m.ui.state.history.reset(s);
    m.ui.click(m.ui.find("editor/map", "view.light", "##value"));
    EXPECT_TRUE(m.ui.find_choice(1, "Light 1"));
    EXPECT_FALSE(m.ui.find_choice(3, "Light 3"));
    m.ui.click(m.ui.find_choice(2, "Light 2 (Lamp)"));
    EXPECT_EQ(s.view.light, 2);
    EXPECT_EQ(m.ui.state.history.undo().view.light, 0);
    // A number above the last selects the last.
    s.view.light = 5;
    m.ui.frames(3);
    EXPECT_FALSE(m.ui.drawn().shows("not there"));
}

TEST(MapReadout, ShowsStoredAndLinearDepthInMetres) {
    DepthCurve curve;
    curve.perspective = true;
    curve.near = 1;
    curve.far = 101;
    const float far_depth = float(curve.convention.far_depth());
    FloatImage values{4, 4, 1, std::vector<float>(16, far_depth)};
    values.data[2] = float(curve.depth(3.5));  // the row at the top is texel row 3
    const auto [where, depth] = texel_readout({2, 3}, {4, 4}, &values, curve, nullptr, false);
    EXPECT_EQ(where, "texel 2, 3");
    EXPECT_TRUE(depth.starts_with("3.5") && depth.find(" m   stored ") != std::string::npos) << depth;
    EXPECT_NEAR(std::stod(depth), 3.5, 1e-4);
    EXPECT_EQ(float(std::stod(depth.substr(depth.find("stored ") + 7))), values.data[2]) << "not exact: " << depth;
    EXPECT_NEAR(std::stod(depth.substr(depth.find("linear ") + 7)), 0.025, 1e-5);
    const std::string empty = texel_readout({2, 0}, {4, 4}, &values, curve, nullptr, false).second;
    EXPECT_TRUE(empty.ends_with("nothing drawn")) << empty;
    EXPECT_NEAR(std::stod(empty), 101, 1e-3);
    EXPECT_EQ(texel_readout({2, 0}, {8, 8}, &values, curve, nullptr, false).second, "") << "of another image";
    const FloatImage level{2, 2, 1, {0.5f, 0.125f, 0.25f, 0.75f}};
    const ShownMap mean{.light = 0, .channel = 1, .name = "mean", .mip = 1, .texels = {2, 2}};
    const auto [place, number] = texel_readout({2, 3}, {4, 4}, &level, curve, nullptr, false, mean, false);
    EXPECT_EQ(place, "texel 2, 3   in mip level 1 texel 1, 1");
    EXPECT_EQ(number, "mean   0.125");
    const FloatImage coordinates{1, 1, 4, {0.6f, 0.85f, 0, 1}};
    const TexelUsage usage(coordinates, 4, 0.5, MapWrap::Border);
    EXPECT_EQ(texel_readout({2, 3}, {4, 4}, nullptr, curve, &usage, false).first, "texel 2, 3   read by 1 pixels");
    EXPECT_EQ(texel_readout({0, 0}, {4, 4}, nullptr, curve, &usage, true).first,
              "texel 0, 0   read by 0 frozen pixels");
}

}  // namespace
}  // namespace si::test
