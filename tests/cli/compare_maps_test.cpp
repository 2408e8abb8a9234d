// Tests of `compare-maps`.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

TEST(CompareMaps, NeedsImportedMaps) {
    const auto folder = fresh_test_folder();
    expect_error("compare-maps boxes", 1, "boxes: it has no imported maps; name a bundle, or set map.bundle to one",
                 folder);
    expect_error("compare-maps boxes --light 99", 2, "--light", folder);
    expect_error("compare-maps boxes --light 0", 1, "light 0 has no imported map to compare with", folder);
    expect_error("compare-maps boxes --border -1", 2, "--border", folder);
    expect_error("compare-maps boxes -o differences.jpg", 2, "must end in .png", folder);
    expect_error("compare-maps", 2, "SCENE", folder);
    EXPECT_TRUE(std::filesystem::is_empty(folder));
}

/// Exports a frame of the scene "boxes" as boxes.bundle.
std::filesystem::path exported_boxes(const Words& settings) {
    const auto folder = fresh_test_folder();
    const ProcessResult r = run_program(Words("export boxes --size 192x108 --bundle boxes.bundle") + settings, folder);
    EXPECT_EQ(r.code, 0) << r.err;
    return folder;
}

SI_TEST_IS(Slow, CompareMaps, AnExportedFrameIsDrawnAgainWithoutADifference);
TEST(CompareMaps, AnExportedFrameIsDrawnAgainWithoutADifference) {
    for (const char* settings :
         {"--set map.resolution=128 --set map.format=d16",
          "--set map.resolution=128 --set map.reversed_z=true --set bias.raster_slope=2 --set bias.raster_units=3",
          "--set map.resolution=128 --set light.fit=lispsm",
          "--set map.resolution=64 --set light.type=point --set light.distance=9"}) {
        SCOPED_TRACE(settings);
        const auto folder = exported_boxes(settings);
        const nlohmann::json json = program_json("compare-maps boxes.bundle --json --check", folder);
        EXPECT_EQ(json["format"], "shadow-inspector-map-comparison");
        EXPECT_EQ(json["passed"], true);
        for (const auto& map : json["maps"]) {
            EXPECT_EQ(map["missed"], 0);
            EXPECT_EQ(map["extra"], 0);
            EXPECT_LE(map["steps"]["max"], 4);
            EXPECT_TRUE(map["lacking"].empty());
        }
        EXPECT_NE(json["bias"][0]["engine_bias"], nullptr);
    }
}

SI_TEST_IS(Later, CompareMaps, ACasterThatTheMapLacksIsNamed);
TEST(CompareMaps, ACasterThatTheMapLacksIsNamed) {
    const auto folder = exported_boxes("--set map.resolution=128 --set object.Boxes/Tower.cast=false");
    const Words command = "compare-maps boxes.bundle --set object.Boxes/Tower.cast=true";
    const ProcessResult text = run_program(command + "-o differences.png", folder);
    EXPECT_EQ(text.code, 0) << text.err;
    EXPECT_NE(text.out.find("Boxes/Tower: the map lacks it"), std::string::npos) << text.out;
    EXPECT_TRUE(std::filesystem::exists(folder / "differences.png"));
    expect_error(command + "--check", 1, "some maps fail the gate", folder);
}

}  // namespace
}  // namespace si
