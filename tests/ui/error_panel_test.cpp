// Tests of the error panel, the artefact legend and the picture comparison over made-up facts: layout and requests.
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <cmath>
#include <set>
#include <utility>

#include "renderer/reference/artefact_picture.h"
#include "renderer/settings/param.h"
#include "tests/ui/ui_harness.h"
#include "ui/widgets/theme.h"

namespace si::test {
namespace {

LiveError made_up_error() {
    LiveError e;
    ErrorMetrics& m = e.metrics;
    m.counted = 123456;
    m.false_shadow = 0.25;
    m.acne = 0.2;
    m.boundary_false_shadow = 0.05;
    m.false_light = 0.000123;
    m.mae = 0.1;
    m.rmse = 0.2;
    m.signed_mean = -0.09;
    m.iou = 0.5;
    m.pixels = {123456, 1000, 2000};
    m.artefacts = {90000, 24691, 5, 4, 6000, 3, 2, 11, 12, 13, 14, 15};
    return e;
}

ReferenceFacts made_up_reference() {
    return {.current = true,
            .wanted = true,
            .build_ms = 100,
            .trace_ms = 200,
            .rays = 1234567,
            .width = 640,
            .height = 480};
}

/// Returns the colours of all vertices of the last frame.
std::set<ImU32> colours() {
    std::set<ImU32> out;
    const ImDrawData* data = ImGui::GetDrawData();
    for (int i = 0; i < data->CmdListsCount; ++i)
        for (const ImDrawVert& v : data->CmdLists[i]->VtxBuffer) out.insert(v.col);
    return out;
}

TEST(ErrorPanel, FitsAtEverySizeInEveryState) {
    for (const auto& [width, height, scale] :
         {std::tuple{1280, 720, 1.0f}, {1600, 900, 1.0f}, {1920, 1080, 1.25f}, {3840, 2160, 2.0f}}) {
        UiHarness ui(width, height, scale);
        ui.state.window.open_page = Page::Error;
        ui.state.layout.bottom_height = 17.2f;
        for (int variant = 0; variant < 4; ++variant) {
            ui.reference = made_up_reference();
            ui.error = made_up_error();
            if (variant == 1) {
                ui.reference->current = false;
                ui.reference->doing = "Tracing rays";
                ui.error.reset();
            }
            if (variant == 2) {
                ui.reference->current = false;
                ui.reference->problem = "Cancelled";
                ui.error.reset();
            }
            if (variant == 3) ui.state.settings.truth.area = true;
            ui.frames(4);
            ASSERT_TRUE(ui.state.shows(Page::Error));
            bool seen = false;
            for (const ImGuiWindow* w : ImGui::GetCurrentContext()->Windows) {
                const std::string_view name(w->Name);
                if (!w->WasActive || name.find("/error_") == std::string_view::npos) continue;
                seen = true;
                EXPECT_LE(w->ContentSize.x, w->InnerRect.GetWidth() + 1) << name << " at " << width << ", " << variant;
                EXPECT_LE(w->ContentSize.y, w->InnerRect.GetHeight() + 1) << name << " at " << width << ", " << variant;
            }
            EXPECT_TRUE(seen);
        }
    }
}

/// Returns the largest opacity of the letters of a text on the screen, 0..255.
int opacity_of(const UiHarness& ui, std::u32string_view text) {
    const auto at = ui.drawn().find(text);
    if (!at) return -1;
    int most = 0;
    const ImDrawData* data = ImGui::GetDrawData();
    for (int i = 0; i < data->CmdListsCount; ++i)
        for (const ImDrawVert& v : data->CmdLists[i]->VtxBuffer)
            if (std::abs(v.pos.x - at->x) < 12 && std::abs(v.pos.y - at->y) < 10 && v.uv.x > 0.02f)
                most = std::max(most, int(v.col >> IM_COL32_A_SHIFT));
    return most;
}

TEST(ErrorPanel, KeepsNumbersInGreyAndEveryClickWhileRaysAreTraced) {
    UiHarness ui(1600, 900);
    ui.state.window.open_page = Page::Error;
    ui.state.layout.bottom_height = 17.2f;
    ui.reference = made_up_reference();
    ui.error = made_up_error();
    ui.frames(4);
    const auto before = ui.drawn().find(U"24691");
    ASSERT_TRUE(before);
    EXPECT_EQ(opacity_of(ui, U"24691"), 255);
    ui.earlier_error = std::exchange(ui.error, std::nullopt);
    ui.reference->current = false;
    ui.reference->doing = "Tracing rays";
    ui.reference->progress = 0.42;
    for (const double seconds : {0.0, 95.0}) {
        ui.reference->seconds_left = seconds;
        ui.frames(3);
        const auto now = ui.drawn().find(U"24691");
        ASSERT_TRUE(now) << "the numbers of the picture before stay";
        EXPECT_EQ(now->x, before->x);
        EXPECT_EQ(now->y, before->y) << "and keep their place";
        EXPECT_LT(opacity_of(ui, U"24691"), 200) << "in grey";
    }
    EXPECT_EQ(ui.lacking({"42 %, 2 min left", "of an earlier picture"}), "");
    ui.click({before->x, before->y});
    EXPECT_EQ(ui.state.artefact_tour.cause, Artefact::Acne) << "a click on a cause counts";
    ui.click(ui.find("error_", "", "Next artefact"));
    EXPECT_NE(ui.state.artefact_tour.waits_for, 0) << "it waits for the rays";
    // Without any picture before, the table has its place already.
    ui.earlier_error.reset();
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"edge aliasing", "Not measured yet"}), "");
    EXPECT_FALSE(ui.prints("24691"));
}

TEST(ErrorPanel, LongTextEndsInAnEllipsis) {
    for (const int width : {1280, 1920}) {
        UiHarness ui(width, 900);
        ui.state.window.open_page = Page::Error;
        ui.state.layout.bottom_height = 17.2f;
        ui.reference = made_up_reference();
        ui.error = made_up_error();
        ui.frames(4);
        const std::u32string all = ui.drawn().read();
        for (const auto& [begins, whole] :
             {std::pair{U"Shadowo", U"Shadowoverlap(IoU)"}, {U"Meansigned", U"Meansignederror(+toolight)"}}) {
            const std::size_t at = all.find(begins);
            ASSERT_NE(at, all.npos) << width;
            const std::u32string_view from = std::u32string_view(all).substr(at);
            const std::size_t dots = from.find(U'…'), letters = std::u32string_view(whole).size();
            EXPECT_EQ(from.starts_with(whole), width == 1920);
            EXPECT_EQ(dots < letters, width == 1280) << "nothing is cut through a letter";
        }
    }
}

TEST(ErrorPanel, RequestsNumbersOnlyWhileShown) {
    UiHarness ui(1280, 720);
    ui.state.layout.strip_open = false;
    EXPECT_FALSE(ui.frames(3).want_error);
    ui.state.window.open_page = Page::Error;
    EXPECT_TRUE(ui.frames(3).want_error);
    ui.state.window.open_page = Page::Log;
    EXPECT_FALSE(ui.frames(3).want_error);
    set_setting(ui.state.settings, "view.overlay", "artefacts");
    EXPECT_TRUE(ui.frames(2).want_error) << "for the legend";
    set_setting(ui.state.settings, "view.overlay", "truth");
    EXPECT_FALSE(ui.frames(2).want_error);
}

TEST(ErrorPanel, LegendHasEveryColour) {
    UiHarness ui(1280, 720);
    set_setting(ui.state.settings, "view.overlay", "artefacts");
    ui.reference = made_up_reference();
    ui.frames(3);
    std::set<ImU32> seen = colours();
    for (const ArtefactStyle& style : artefact_styles()) EXPECT_TRUE(seen.contains(theme::rgb(style.rgb))) << style.key;
    ui.error = made_up_error();
    ui.frames(2);
}

TEST(PictureComparison, EveryViewFitsAndNamesMissingParts) {
    for (const auto& [width, height, scale] : {std::tuple{1280, 720, 1.0f}, {3840, 2160, 2.0f}}) {
        UiHarness ui(width, height, scale);
        ui.reference = made_up_reference();
        for (const ComparisonView view : {ComparisonView::Swipe, ComparisonView::SideBySide, ComparisonView::Difference,
                                          ComparisonView::Alone, ComparisonView::Off}) {
            ui.state.comparison.view = view;
            for (int variant = 0; variant < 3; ++variant) {
                ui.state.comparison.reference = variant != 1;
                ui.picture_comparison.reset();
                if (variant > 0) {
                    ui.picture_comparison = PictureComparisonFacts{.label = "x", .mae = 0.01};
                    const FrameResult made_up = made_up_frame(ui.scene, ui.state.settings);
                    if (variant == 2)
                        ui.picture_comparison->picture = ui.picture_comparison->difference = made_up.colour;
                    if (variant == 1) ui.picture_comparison->problem = "no such preset";
                }
                const EditorRequests requests = ui.frames(3);
                EXPECT_GT(requests.scene_width, 100);
                EXPECT_GT(ImGui::GetDrawData()->TotalVtxCount, 2000);
            }
        }
    }
}

TEST(PictureComparison, DragMovesOnlyTheLine) {
    UiHarness ui(1280, 720);
    ui.state.comparison = {.view = ComparisonView::Swipe};
    ui.frames(3);
    ASSERT_TRUE(ui.state.viewport.view);
    const PictureView view = *ui.state.viewport.view;
    const auto at = [&](double x) {
        return glm::vec2(view.origin.x + x * view.size.x, view.origin.y + 0.5 * view.size.y);
    };
    const Settings before = ui.state.settings;
    ui.drag(at(0.5), at(0.2));
    EXPECT_NEAR(ui.state.comparison.at, 0.2, 0.01);
    EXPECT_EQ(ui.state.settings, before);
    EXPECT_FALSE(ui.state.probe_pixel);
    ui.drag(at(0.2), glm::vec2(5, 300));
    EXPECT_GE(ui.state.comparison.at, 0.f) << "not beyond the picture";
    ui.drag(at(0.7), at(0.8));
    EXPECT_NE(ui.state.settings, before) << "elsewhere the camera turns";
}

}  // namespace
}  // namespace si::test
