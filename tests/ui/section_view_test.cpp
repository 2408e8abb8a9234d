// Tests of the cross-section in the probe panel: next to the verdict, laid out once without changes, and never while
// hidden.
#include "ui/panels/section_view.h"

#include <gtest/gtest.h>

#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/ui_harness.h"
#include "ui/widgets/theme.h"

namespace si::test {
namespace {

Section step_of_shadow() {
    Section s;
    s.shadowed = true;
    s.classified = true;
    s.cut = {.axis = 0, .first = 100, .count = 5, .reach_texels = 0.5};
    s.lookup_texel = 102;
    s.texel_m = 0.04;
    s.lit = false;
    s.visibility = 0;
    s.verdict = "acne: needs 0.6 texels of bias here, has 0";
    for (int i = 0; i < 5; ++i) {
        const double x = (i - 2.5) * 0.04;
        s.steps.push_back({.texel = 100 + i,
                           .from = {x, x + 0.02},
                           .to = {x + 0.04, x + 0.02},
                           .compared_from = {x, 0},
                           .compared_to = {x + 0.04, 0},
                           .weight = i == 2 ? 1.0 : 0,
                           .meets = KernelTap::Meets::Own});
    }
    s.least = {0.006, 0.6, 0.024};
    s.window_from = 0.024;
    s.has_window = true;
    return s;
}

TEST(SectionView, IsNextToTheVerdictAndIsLaidOutOnce) {
    UiHarness ui(1600, 900);
    ui.state.probe_pixel = glm::ivec2(3, 4);
    ui.state.window.open_page = Page::Pixel;
    ui.sections = std::make_shared<const std::vector<Section>>(1, step_of_shadow());
    ui.frames(5);
    EXPECT_TRUE(ui.prints("needs 0.6 texels of bias"));
    EXPECT_TRUE(ui.prints("stored in texel 102"));
    const int drawn = ui.state.probe_panel.section_views.drawn;
    EXPECT_GE(drawn, 1);
    ui.frames(20);
    EXPECT_EQ(ui.state.probe_panel.section_views.drawn, drawn) << "nothing has changed";
    ui.sections = std::make_shared<const std::vector<Section>>(1, step_of_shadow());
    ui.frames(5);
    EXPECT_EQ(ui.state.probe_panel.section_views.drawn, drawn + 1) << "another pixel";
    ui.state.window.open_page = Page::Settings;
    ui.frames(3);
    ui.sections = std::make_shared<const std::vector<Section>>(1, step_of_shadow());
    ui.frames(5);
    EXPECT_EQ(ui.state.probe_panel.section_views.drawn, drawn + 1) << "hidden";
    EXPECT_FALSE(ui.prints("stored in texel 102"));
}

TEST(SectionView, ExplainsTheHoveredMark) {
    for (const bool fills : {false, true}) {  // the window
        SCOPED_TRACE(fills);
        UiHarness ui(1600, fills ? 600 : 900);
        if (fills) ui.state.window.maximised = Panel::Inspector;
        ui.state.probe_pixel = glm::ivec2(3, 4);
        ui.state.window.open_page = Page::Pixel;
        ui.sections = std::make_shared<const std::vector<Section>>(1, step_of_shadow());
        ui.frames(5);
        EXPECT_FALSE(ui.prints("one step per texel"));
        ASSERT_EQ(ui.state.probe_panel.section_views.views.size(), 1u);
        const std::vector<LegendRow> legend = ui.state.probe_panel.section_views.views[0].drawing.legend;
        ASSERT_GE(legend.size(), 5u);
        const ScreenRect drawing = ui.state.shots.drawing_rect;
        for (const glm::vec2 part : {glm::vec2(0.1f, 0.1f), {0.3f, 0.6f}, {0.9f, 0.9f}}) {
            ui.move(drawing.lo + part * drawing.size);
            ui.frames(3);
            for (const LegendRow& row : legend)
                EXPECT_TRUE(ui.drawn().shows(std::string(row.text))) << row.text << " is not told, or is cut";
            EXPECT_FALSE(ui.prints("first surface from the light")) << "nothing was traced";
            EXPECT_FALSE(ui.prints("tap lit"));
            const auto words = ui.drawn().find(U"onesteppertexel");
            ASSERT_TRUE(words);
            EXPECT_TRUE(words->x > drawing.lo.x + drawing.size.x || words->x < drawing.lo.x) << "hidden by its words";
            for (const LegendRow& row : legend) {
                std::u32string letters;
                for (const char c : row.text)
                    if (c != ' ') letters += char32_t(static_cast<unsigned char>(c));
                const auto at = ui.drawn().find(letters);
                ASSERT_TRUE(at) << row.text;
                EXPECT_GT(at->y, drawing.lo.y) << row.text << ": over the tabs' titles and the words on the pixel";
            }
        }
        const int drawn = ui.state.probe_panel.section_views.drawn;
        ui.frames(5);
        EXPECT_EQ(ui.state.probe_panel.section_views.drawn, drawn) << "laid out once";
        ui.move({5, 5});
        ui.frames(3);
        EXPECT_FALSE(ui.prints("one step per texel"));
        ui.click(drawing.lo + 0.5f * drawing.size, 1);
        ui.frames(2);
        EXPECT_TRUE(ui.prints("Save the drawing (PNG and SVG)"));
        EXPECT_FALSE(ui.prints("one step per texel")) << "the menu stands alone";
    }
}

TEST(SectionView, IsDrawnInFullForAScreenshot) {
    UiHarness ui(700, 480);  // a panel too small for the drawing
    ui.frames(2);
    const Section section = step_of_shadow();
    const SectionSheet sheet = section_sheet(section);
    EXPECT_NEAR(sheet.width, SectionPage().width / SectionPage().em * theme::small()->FontSize, 1) << "as an SVG";
    EXPECT_GT(sheet.height, sheet.width / 2);
    ASSERT_TRUE(sheet.list);
    EXPECT_GT(sheet.list->IdxBuffer.Size, 1000);
    for (const ImDrawVert& v : sheet.list->VtxBuffer) {
        EXPECT_TRUE(v.pos.x >= -2 && v.pos.x <= float(sheet.width) + 2) << v.pos.x;
        EXPECT_TRUE(v.pos.y >= -2 && v.pos.y <= float(sheet.height) + 2) << v.pos.y;
    }
    ui.frames(2);  // the next picture is unchanged
}

TEST(SectionView, LeavesTheVerdictItsSpaceAtAnySize) {
    for (const auto& [w, h, scale] : {std::tuple{3840, 2160, 2.0f}, {1280, 720, 1.0f}, {700, 480, 1.0f}}) {
        UiHarness ui(w, h, scale);
        ui.state.probe_pixel = glm::ivec2(3, 4);
        ui.state.window.open_page = Page::Pixel;
        ui.state.settings.light_count = 3;
        ui.sections = std::make_shared<const std::vector<Section>>(3, step_of_shadow());
        ui.frames(4);
        EXPECT_TRUE(ui.prints("in shadow: its texel stores")) << w;
    }
}

SI_TEST_IS(Later, EditorSection, IsComputedOnceAndOnlyWhileShown);
TEST(EditorSection, IsComputedOnceAndOnlyWhileShown) {
    // The bias leaves the pixel without acne, so that no fix is searched.
    TestEditor editor(
        editor_options("boxes", {"bias.kind=constant", "bias.normal=0", "bias.constant=4", "map.resolution=512"}));
    EditorState& state = editor.state();
    state.window.open_page = Page::Log;
    state.layout = kWideLayout;
    editor.settle();
    state.probe_pixel = glm::ivec2(170, 230);
    editor.settle();
    ASSERT_TRUE(editor.facts().probe && editor.facts().probe->hit);
    EXPECT_FALSE(editor.facts().sections) << "nobody looks";
    EXPECT_EQ(state.probe_panel.section_views.drawn, 0);
    state.window.open_page = Page::Pixel;
    editor.settle();
    const Sections shown = editor.model().facts().sections;
    ASSERT_TRUE(shown && shown->size() == 1);
    EXPECT_TRUE(shown->at(0).classified) << "with the reference";
    EXPECT_FALSE(shown->at(0).profile.empty());
    editor.frames(5);
    EXPECT_EQ(editor.model().facts().sections, shown) << "kept";
    state.settings.bias.constant = 4.01;
    editor.settle();
    ASSERT_TRUE(editor.model().facts().sections);
    EXPECT_NE(editor.model().facts().sections, shown) << "another test";
}

}  // namespace
}  // namespace si::test
