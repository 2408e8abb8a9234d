// Tests of the panel Imported: requests, numbers, missing casters, and the switch between the pictures.
#include <gtest/gtest.h>

#include "renderer/base/index_of.h"
#include "renderer/inspect/map_comparison.h"
#include "renderer/scenes/builtin.h"
#include "tests/support/traits.h"
#include "tests/ui/ui_harness.h"
#include "ui/state/selection.h"

namespace si::test {
namespace {

/// Returns a comparison of an 8 x 8 map that lacks a caster of 6 texels.
ComparedMap made_up_comparison(const std::string& path) {
    LightView view;
    view.curve = {.perspective = false, .near = 10, .far = 30, .convention = {}, .warp = {}};
    view.set_half_extents(glm::dvec2(4));
    ComparedMap out;
    out.view = view;
    out.imported = out.drawn = {8, 8, 1, std::vector<float>(64, 0.5f)};
    for (std::size_t i = 0; i < 6; ++i) out.imported.data[i] = 1;
    out.numbers = compare_maps(out.imported, out.drawn, view, MapFormat::D16);
    out.lacking = {{.object = 0, .path = path, .texels = 6, .empty = 6, .farther = 0}};
    return out;
}

/// Opens the tab with a comparison. @param scale_m difference at the end of the scale of colours
void show_comparison(UiHarness& ui, const ComparedMap& map, double scale_m) {
    ui.maps_imported = true;
    ui.imported = {
        .compared_map = &map, .compared_picture = {1, 8, 8}, .compared_scale_m = scale_m, .comparison_problem = {}};
    ui.state.window.open_page = Page::Imported;
    ui.frames(4);
}

TEST(ImportedPanel, ComparesOnlyImportedMapsAndOnlyWhileShown) {
    UiHarness ui(1900, 1000);
    ui.maps_imported = true;
    EXPECT_FALSE(ui.frames(3).want_map_comparison);
    ui.state.window.open_page = Page::Imported;
    EXPECT_TRUE(ui.frames(4).want_map_comparison);
    EXPECT_TRUE(ui.prints("Comparing ..."));
    ui.maps_imported = false;
    EXPECT_FALSE(ui.frames(2).want_map_comparison);
    EXPECT_TRUE(ui.prints("map is drawn by this program"));
    ui.maps_imported = true;
    ui.imported.comparison_problem = "light 0 has no shadow map";
    EXPECT_TRUE(ui.frames(2).want_map_comparison) << "another scene may have none of the problem";
    EXPECT_TRUE(ui.prints("light 0 has no shadow map"));
}

TEST(ImportedPanel, ShowsNumbersGateAndPicture) {
    UiHarness ui(1900, 1000);
    const ComparedMap map = made_up_comparison("Root/Box");
    show_comparison(ui, map, 0.25);
    EXPECT_EQ(ui.lacking({"Theirs", "Ours", "Difference", "failed: 6 texels are extra", "Covered 58 of 64",
                          "Missed 0 0 %", "Extra 6 10.3 %", "0 steps", "-250 mm", "+250 mm", "6 of 6"}),
              "");
    for (const auto& [picture, label] : {std::pair{ImportedPicture::Drawn, "Ours"},
                                         {ImportedPicture::Imported, "Theirs"},
                                         {ImportedPicture::Difference, "Difference"}}) {
        ui.click(ui.find("imported", "", label));
        EXPECT_EQ(ui.state.imported_picture, picture);
    }
}

SI_TEST_IS(Later, ImportedPanel, TheEnginesBiasIsEntered);
TEST(ImportedPanel, TheEnginesBiasIsEntered) {
    UiHarness ui(1900, 1000);
    ui.maps_imported = true;
    ui.state.window.open_page = Page::Imported;
    ui.frames(4);
    EXPECT_FALSE(ui.find("imported", "map.bundle_bias", "##value")) << "there is no bundle";
    ui.state.settings.map.bundle = "frame.bundle";
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"Bundle's maps", "Engine's bias", "The engine's bias is unknown: no verdict speaks"}), "");
    EXPECT_FALSE(ui.find("imported", "bias.constant", "##value"));
    ui.click(ui.find("imported", "map.bundle_bias", "##value"));
    ui.frames(2);
    ui.click(ui.find_choice(index_of(BundleBiasSource::Entered), "entered by hand"));
    EXPECT_EQ(ui.state.settings.map.bundle_bias, BundleBiasSource::Entered);
    ui.frames(2);
    EXPECT_FALSE(ui.prints("The engine's bias is unknown"));
    for (const char* key : {"bias.kind", "bias.unit", "bias.constant", "bias.slope", "bias.normal"})
        EXPECT_TRUE(ui.find("imported", key, "##value")) << key;
    ui.state.settings.map.bundle_maps = BundleMaps::Drawn;
    ui.maps_imported = false;
    ui.frames(2);
    EXPECT_TRUE(ui.prints("This program draws the maps of the bundle's lights"));
    EXPECT_TRUE(ui.find("imported", "map.bundle_maps", "##value")) << "the way back";
}

TEST(ImportedPanel, SwitchesLeaveTexelsOut) {
    UiHarness ui(1900, 1000);
    const ComparedMap map = made_up_comparison("Root/Box");
    show_comparison(ui, map, 1);
    EXPECT_EQ(ui.state.imported_left_out, ImportedLeftOut{});
    ui.click(ui.find("imported", "", "No masked"));
    EXPECT_EQ(ui.state.imported_left_out, (ImportedLeftOut{.masked = true, .border = false}));
    ui.click(ui.find("imported", "", "No border"));
    ui.click(ui.find("imported", "", "No masked"));
    EXPECT_EQ(ui.state.imported_left_out, (ImportedLeftOut{.masked = false, .border = true}));
}

TEST(ImportedPanel, AClickOnAMissingCasterSelectsIt) {
    UiHarness ui(1900, 1000);
    const ComparedMap map = made_up_comparison("Root/Box");
    show_comparison(ui, map, 1);
    EXPECT_FALSE(is_selected(ui.state, "Root/Box"));
    ui.click(ui.find("lacking casters", "lacking", "Root/Box###lacking 0"));
    EXPECT_TRUE(is_selected(ui.state, "Root/Box"));
}

}  // namespace
}  // namespace si::test
