// Tests of panel texts: UTF-8, encoded once, with letters of the font. UiHarness::frame() checks every frame; these
// windows are so tall that nothing is cut off.
#include <gtest/gtest.h>
#include <imgui.h>

#include "tests/support/text.h"
#include "tests/ui/ui_harness.h"

namespace si::test {
namespace {

bool holds(const std::u32string& text, std::u32string_view part) {
    return text.find(part) != std::u32string::npos;
}

TEST(PrintedText, OfEveryTabEqualsItsSource) {
    UiHarness ui(1900, 2200);
    ui.state.settings.light_count = 2;
    ui.state.probe_pixel = glm::ivec2(3, 4);
    ui.state.layout.bottom_height = 100;  // em
    ui.reference = ReferenceFacts{
        .current = true, .rays = 1'000'000, .noise = "noise 0.0031, 64 samples a pixel", .width = 8, .height = 8};
    ui.error = LiveError{};
    ui.map_facts = MapPlots{};
    ui.state.probe_panel.lists_numbers = true;
    for (int i = 0; i < kPages; ++i) {
        const auto page = Page(i);
        ui.state.window.open_page = page;
        ui.frames(4);
        const std::u32string text = ui.printed();
        EXPECT_GT(text.size(), 300u) << i;
        if (page == Page::Pixel) {
            EXPECT_TRUE(holds(text, U"N\u00b7L0.60000"));
        }
        if (page == Page::Effects) {
            EXPECT_TRUE(holds(text, U"shadowmap0"));
        }
        if (page == Page::Error) {
            EXPECT_TRUE(holds(text, U"noise0.0031"));
        }
    }
}

TEST(PrintedText, FindsTheDrawnText) {
    UiHarness ui(900, 600);
    ui.frames(2);
    const auto drawn = [&](const char* text) {
        ImGui::NewFrame();
        ImGui::GetForegroundDrawList()->AddText({20, 20}, 0xffffffff, text);
        ImGui::Render();
        return ui.printed();
    };
    EXPECT_EQ(drawn("N\xc2\xb7L 0.5"), U"N\u00b7L0.5");
    EXPECT_EQ(text_fault(drawn("N\xc2\xb7L 36\xc2\xb0")), "");
    EXPECT_NE(text_fault(drawn("N\xc3\x82\xc2\xb7L")), "") << "encoded twice";
    EXPECT_NE(text_fault(drawn("broken \xc2")), "");
    EXPECT_NE(text_fault(drawn("\xe2\x99\xbb")), "") << "a letter that the font lacks";
}

}  // namespace
}  // namespace si::test
