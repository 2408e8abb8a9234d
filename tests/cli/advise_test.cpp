// Tests of `advise`: its figures hold, and the autopilot's preset stays within the bound.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/process.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Json measured(std::vector<std::string> args) {
    args.insert(args.begin(), "measure");
    args.insert(args.end(), {"--size", "160x90", "--no-time", "--json"});
    const auto r = run_program(args);
    EXPECT_EQ(r.code, 0) << r.err;
    return Json::parse(r.out, nullptr, false);
}

TEST(AdviseCommand, PrintsOnlyAdviceThatHoldsAndAppliesOne) {
    const std::vector<std::string> scene = {"boxes", "--set", "map.samples=4", "--set", "filter.kernel=pcf7"};
    std::vector<std::string> args = {"advise", "--size", "160x90", "--json", "--cost", "forced"};
    args.insert(args.begin() + 1, scene.begin(), scene.end());
    const auto r = run_program(args);
    ASSERT_EQ(r.code, 0) << r.err;
    const Json json = Json::parse(r.out);
    EXPECT_EQ(json["format"], "shadow-inspector-advice");
    EXPECT_EQ(json["timed"], "forced");
    EXPECT_EQ(json["time"]["timed"], "forced");
    ASSERT_FALSE(json["advice"].empty());
    const double now = measured(scene)["error"]["mae"];
    EXPECT_EQ(json["error"], now);
    for (const Json& row : json["advice"]) {
        EXPECT_TRUE(row["holds"]);
        EXPECT_FALSE(row["settings"].empty());
        std::vector<std::string> with = scene;
        for (const auto& [key, value] : row["settings"].items())
            with.insert(with.end(), {"--set", key + "=" + value.get<std::string>()});
        EXPECT_EQ(measured(with)["error"]["mae"], row["error"]["after"]) << row.dump(2);
        const double added = row["error"]["after"].get<double>() - now;
        if (row["claim"] == "same") {
            EXPECT_LE(added, row["error"]["tolerance"]);
        }
    }
    for (const Json& row : json["tried"]) EXPECT_TRUE(row["why_not"].is_string());
    for (const Json& row : json["findings"])
        EXPECT_TRUE(row["severity"] == "error" || row["severity"] == "warning" || row["severity"] == "hint");
}

TEST(AdviseCommand, AutopilotWritesAPresetWithinItsBound) {
    const fs::path preset = fresh_test_folder() / "cheap.json";
    const auto r = run_program({"advise", "boxes", "--max-error", "0.02", "--vary", "filter.kernel=hard,pcf3", "--vary",
                                "map.resolution=256,512", "--size", "160x90", "-o", preset.string(), "--json"});
    ASSERT_EQ(r.code, 0) << r.err;
    const Json json = Json::parse(r.out);
    EXPECT_TRUE(json["held"]);
    EXPECT_EQ(json["combinations"], 4);
    EXPECT_EQ(json["cases"].size(), 4u);
    const Json error = measured({"boxes", "--preset", preset.string()})["error"];
    EXPECT_LE(error["mae"], 0.02);
    EXPECT_EQ(error["mae"], json["best"]["error"]);
    for (const Json& d : json["dropped"]) EXPECT_NE(d["was"], d["is"]);
}

TEST(AdviseCommand, ReportsAnUnreachableBoundAndWritesNothing) {
    const fs::path preset = fresh_test_folder() / "none.json";
    const auto r = run_program({"advise", "boxes", "--max-error", "1e-9", "--vary", "map.resolution=256", "--size",
                                "64x36", "-o", preset.string()});
    EXPECT_EQ(r.code, 1);
    EXPECT_NE(r.err.find("cannot be met by any tried combination; the nearest is"), std::string::npos) << r.err;
    EXPECT_FALSE(fs::exists(preset));
}

TEST(AdviseCommand, RefusesWrongArguments) {
    const std::string preset = (fresh_test_folder() / "p.json").string();
    const auto refused = [&](std::vector<std::string> args, int code, const std::string& about) {
        args.insert(args.begin(), {"advise", "boxes"});
        const auto r = run_program(args);
        EXPECT_EQ(r.code, code) << r.err;
        EXPECT_NE(r.err.find(about), std::string::npos) << r.err;
        EXPECT_FALSE(fs::exists(preset));
    };
    refused({"-o", preset}, 2, "--max-error or --max-ms");
    refused({"--vary", "map.resolution=256"}, 2, "--max-error or --max-ms");
    refused({"--max-error", "0"}, 2, "--max-error: \"0\" is not a number above 0");
    refused({"--max-error", "nan"}, 2, "\"nan\" is not a number above 0");
    refused({"--max-ms", "5", "-o", "p.txt"}, 2, ".json");
    refused({"--cost", "soon"}, 2, "forced, camera, light");
    refused({"--error", "prettiness"}, 2, "it is one of mae");
    refused({"--max-ms", "5", "--vary", "map.resolution=many"}, 2, "map.resolution");
}

TEST(CostLabel, NamesTheTimedFrames) {
    const auto measure = [](const std::string& cost) {
        const auto r = run_program({"measure", "boxes", "--size", "64x36", "--json", "--cost", cost});
        EXPECT_EQ(r.code, 0) << r.err;
        return Json::parse(r.out, nullptr, false)["time"];
    };
    const auto has_map = [](const Json& time) { return time["shadow_maps_ms"]["high"].get<double>() > 0; };
    EXPECT_TRUE(has_map(measure("forced")));
    EXPECT_TRUE(has_map(measure("light")));
    const Json camera = measure("camera");
    EXPECT_FALSE(has_map(camera)) << "the map of a light that stands still is kept";
    EXPECT_EQ(camera["timed"], "camera");
    EXPECT_GT(camera["total_ms"]["median"], 0);
    const auto text = run_program({"measure", "boxes", "--size", "64x36"});
    EXPECT_NE(text.out.find("ms a frame while the camera moves"), std::string::npos) << text.out;
}

}  // namespace
}  // namespace si
