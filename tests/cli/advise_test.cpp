// Tests of `advise`: its figures hold, and the autopilot's preset stays within the bound.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/error_text.h"
#include "tests/support/process.h"
#include "tests/support/text.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Json measured(const Words& arguments) {
    return program_json("measure" + arguments + "--size 160x90 --no-time");
}

SI_TEST_IS(Slow, AdviseCommand, PrintsOnlyAdviceThatHoldsAndAppliesOne);
TEST(AdviseCommand, PrintsOnlyAdviceThatHoldsAndAppliesOne) {
    const Words scene = "boxes --set map.samples=4 --set filter.kernel=pcf7";
    const Json json = program_json("advise" + scene + "--size 160x90 --cost forced");
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json["format"], "shadow-inspector-advice");
    EXPECT_EQ(json["timed"], "forced");
    EXPECT_EQ(json["time"]["timed"], "forced");
    EXPECT_GT(json["time"]["shadow_maps_ms"]["high"], 0) << "forced frames draw their maps";
    ASSERT_FALSE(json["advice"].empty());
    const double now = measured(scene)["error"]["mae"];
    EXPECT_EQ(json["error"], now);
    for (const Json& row : json["advice"]) {
        EXPECT_TRUE(row["holds"]);
        EXPECT_FALSE(row["settings"].empty());
        EXPECT_EQ(measured(scene + set_words(row["settings"]))["error"]["mae"], row["error"]["after"]) << row.dump(2);
        const double added = row["error"]["after"].get<double>() - now;
        if (row["claim"] == "same") {
            EXPECT_LE(added, row["error"]["tolerance"]);
        }
    }
    for (const Json& row : json["tried"]) EXPECT_TRUE(row["why_not"].is_string());
    for (const Json& row : json["findings"])
        EXPECT_TRUE(row["severity"] == "error" || row["severity"] == "warning" || row["severity"] == "hint");
}

SI_TEST_IS(Later, AdviseCommand, AutopilotWritesAPresetWithinItsBound);
TEST(AdviseCommand, AutopilotWritesAPresetWithinItsBound) {
    const fs::path preset = fresh_test_folder() / "cheap.json";
    const Json json = program_json(
        "advise boxes --max-error 0.02 --vary filter.kernel=hard,pcf3 --vary map.resolution=256,512 --size 160x90 -o" +
        Words{preset.string()});
    ASSERT_TRUE(json.is_object());
    EXPECT_TRUE(json["held"]);
    EXPECT_EQ(json["combinations"], 4);
    EXPECT_EQ(json["cases"].size(), 4u);
    const Json error = measured({"boxes", "--preset", preset})["error"];
    EXPECT_LE(error["mae"], 0.02);
    EXPECT_EQ(error["mae"], json["best"]["error"]);
    for (const Json& d : json["dropped"]) EXPECT_NE(d["was"], d["is"]);
}

TEST(AdviseCommand, ReportsAnUnreachableBoundAndWritesNothing) {
    const fs::path preset = fresh_test_folder() / "none.json";
    expect_error("advise boxes --max-error 1e-9 --vary map.resolution=256 --size 64x36 -o" + Words{preset.string()}, 1,
                 "cannot be met by any tried combination; the nearest is");
    EXPECT_FALSE(fs::exists(preset));
}

SI_TEST_IS(Slow, CostLabel, NamesTheTimedFrames);
TEST(CostLabel, NamesTheTimedFrames) {
    const auto measure = [](const std::string& cost) {
        const Json json = program_json("measure boxes --size 64x36 --set map.resolution=256 --cost " + cost);
        EXPECT_EQ(test::text_fault(json.dump()), "");
        return json["time"];
    };
    const auto has_map = [](const Json& time) { return time["shadow_maps_ms"]["high"].get<double>() > 0; };
    EXPECT_TRUE(has_map(measure("light")));
    const Json camera = measure("camera");
    EXPECT_FALSE(has_map(camera)) << "the map of a light that stands still is kept";
    EXPECT_EQ(camera["timed"], "camera");
    EXPECT_GT(camera["total_ms"]["median"], 0);
    const auto text = run_program("measure boxes --size 64x36 --set map.resolution=256");
    const bool processor = camera["clock"].get<std::string>().starts_with("processor time");
    EXPECT_TRUE(
        test::mentions(text.out, {processor ? "ms of processor a frame while" : "ms a frame while", "camera moves"}))
        << text.out;
    EXPECT_EQ(camera["wall_ms"].is_null(), !processor);
    EXPECT_EQ(text.out.find("ms of wall time") == std::string::npos, !processor) << text.out;
    EXPECT_EQ(test::text_fault(text.out), "");
}

}  // namespace
}  // namespace si
