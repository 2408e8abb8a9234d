// Tests of the panel of numeric health: requests, displayed findings, and clicks on a finding.
#include <gtest/gtest.h>

#include "tests/ui/ui_harness.h"

namespace si::test {
namespace {

NumericHealth made_up_health() {
    NumericHealth health;
    health.findings = {{.fault = NumberFault::NegativeVariance,
                        .image = Result::ShadowMaps,
                        .place = "shadow map of light 0",
                        .light = 0,
                        .view = 0,
                        .count = 3,
                        .first = {40, 7},
                        .worst = {100, 20},
                        .value = -0.5,
                        .unit = "texel"},
                       {.fault = NumberFault::NotANumber,
                        .image = Result::Visibility,
                        .place = "visibility of light 0",
                        .light = 0,
                        .count = 1,
                        .first = {33, 12},
                        .worst = {33, 12},
                        .unit = "pixel"}};
    return health;
}

TEST(NumbersPanel, RequestsNumbersOnlyWhileShownAndReportsFiniteOnes) {
    UiHarness ui(1900, 1000);
    EXPECT_FALSE(ui.frames(3).want_health);
    ui.state.window.open_page = Page::Numbers;
    EXPECT_TRUE(ui.frames(4).want_health);
    EXPECT_EQ(ui.lacking({"Searching"}), "");
    NumericHealth sound;
    sound.images = 7;
    sound.numbers = 4321;
    ui.health = &sound;
    ui.frames(2);
    EXPECT_EQ(ui.lacking({"All numbers are sound.", "4321 numbers in 7 images"}), "");
}

TEST(NumbersPanel, ListsHoldersOfMemory) {
    UiHarness ui(1900, 1000);
    EXPECT_FALSE(ui.frames(3).want_memory);
    ui.state.window.open_page = Page::Numbers;
    EXPECT_TRUE(ui.frames(4).want_memory);
    MemoryReport memory;
    memory.process = {.resident = 321u << 20, .peak = 654u << 20, .heap = 100u << 20, .heap_free = 33u << 20};
    memory.holders = {{"shadow maps", 128u << 20, 256u << 20, 2}, {"scenes", 3u << 20, 3u << 20, 1}};
    ui.memory = &memory;
    ui.frames(2);
    EXPECT_EQ(ui.lacking({"321 MiB resident", "654 MiB at most", "131 MiB held by name", "33 MiB free"}), "");
    EXPECT_FALSE(ui.prints("shadow maps 128 MiB 256 MiB 2 things")) << "open at once";
    ui.click(ui.find("numbers", "", "###memory"));
    ui.frames(2);
    EXPECT_EQ(ui.lacking({"shadow maps 128 MiB 256 MiB 2 things", "scenes 3.0 MiB 3.0 MiB 1 thing"}), "");
}

TEST(NumbersPanel, ClickShowsTheTexelInTheMapOrProbesThePixel) {
    UiHarness ui(1300, 800);
    const NumericHealth health = made_up_health();
    ui.health = &health;
    ui.state.window.open_page = Page::Numbers;
    ui.state.settings.view.map_source = MapSource::Camera;
    ui.frames(4);
    EXPECT_EQ(ui.lacking({"a variance below 0", "shadow map of light 0", "3 texels", "40,7", "100,20", "-0.5", "NaN"}),
              "");
    const auto row = ui.find("numbers", "findings", "a variance below 0###finding 0");
    ASSERT_TRUE(row);
    ui.click(*row);
    EXPECT_EQ(ui.state.settings.view.map_source, MapSource::Light);
    ASSERT_TRUE(ui.state.map.marked_texel);
    EXPECT_EQ(ui.state.map.marked_texel->texel, glm::ivec2(100, 20));
    EXPECT_GT(ui.state.map.window.zoom, 2) << "the texel is too small to see";
    EXPECT_FALSE(ui.state.probe_pixel);
    for (float y = row->y + 10; y < row->y + 40 && !ui.state.probe_pixel; y += 5) ui.click({row->x, y});
    EXPECT_EQ(ui.state.probe_pixel, glm::ivec2(33, 12));
}

}  // namespace
}  // namespace si::test
