// Tests of `tune`: its preset is free of acne and holds no more bias than needed.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

TEST(TuneCommand, WritesTheMinimumBiasWithoutAcne) {
    const fs::path folder = fresh_test_folder();
    const auto measured = [&](const Words& more) {
        return program_json("measure boxes --preset least.json --size 320x180 --no-time" + more, folder)["error"];
    };
    const Json json = program_json(
        "tune boxes --set map.resolution=512 --set bias.normal=0 --set bias.constant=0 --size 320x180 -o least.json",
        folder);
    ASSERT_TRUE(json.is_object());
    EXPECT_TRUE(json["found"]);
    EXPECT_GT(json["before"]["acne_px"], 100);
    ASSERT_FALSE(json["families"].empty());
    int chosen = 0;
    for (const Json& family : json["families"]) {
        EXPECT_EQ(family["acne_px"] == 0, family["no_acne"].get<bool>());
        EXPECT_GT(family["gap_p95_m"], 0);
        EXPECT_GE(family["shift_p95_m"], 0);
        if (!family["no_acne"].get<bool>()) continue;
        // The selected family loses the fewest pixels.
        for (const Json& other : json["families"])
            EXPECT_TRUE(!other["chosen"].get<bool>() || other["lost_px"] <= family["lost_px"]) << json["families"];
        chosen += family["chosen"].get<bool>();
    }
    EXPECT_EQ(chosen, 1);
    EXPECT_EQ(json["families"].size(), 3u) << "all that were tried stand side by side";
    EXPECT_FALSE(json["settings"].contains("map.resolution"));
    const Json tuned = measured({});
    EXPECT_EQ(tuned["acne"], 0);
    // Acne appears with ten percent less of any active bias.
    Json less;
    for (const char* key : {"bias.normal", "bias.slope", "bias.constant"})
        if (json["settings"].contains(key)) less[key] = std::to_string(0.9 * json["settings"][key].get<double>());
    ASSERT_FALSE(less.empty());
    EXPECT_GT(measured(set_words(less))["any_acne"], tuned["any_acne"]);
    const std::string written = file_bytes(folder / "least.json");
    EXPECT_NE(written.find("least bias without acne"), std::string::npos) << "the preset says what it is";
}

TEST(TuneCommand, UsesTheReferenceOptionsOfMeasure) {
    const fs::path folder = fresh_test_folder();
    const auto tuned = [&](const Words& sets) {
        const Words scene = "boxes --set map.resolution=512 --size 160x90" + sets;
        const Json before = program_json("tune -o least.json" + scene, folder)["before"]["error"];
        const Json error = program_json("measure --no-time" + scene)["error"];
        for (const char* key : {"pixels", "mae", "false_shadow", "boundary_px_mean"})
            EXPECT_EQ(before[key], error[key]) << key;
        return before;
    };
    const int all = tuned({})["pixels"]["counted"], some = tuned("--set truth.step=4")["pixels"]["counted"];
    EXPECT_NEAR(double(some) / all, 1.0 / 16, 0.01);
    tuned("--set truth.area=true --set light.size=3 --set truth.samples=16 --set truth.noise=0.1 --set truth.step=3");
}

SI_TEST_IS(Long, TuneCommand, StaysWithinTheRequestedError);  // compiles and times all kernels of three families
TEST(TuneCommand, StaysWithinTheRequestedError) {
    const fs::path folder = fresh_test_folder();
    const Json json = program_json("tune boxes --max-error 0.02 --size 160x90 -o accurate.json", folder);
    ASSERT_TRUE(json.is_object());
    int chosen = 0, resolution = 0;
    double cheapest = 1e300, taken = 0;
    for (const Json& c : json["candidates"]) {
        if (!c["within_limits"].get<bool>()) continue;
        EXPECT_LE(c["error"], 0.02);
        cheapest = std::min(cheapest, c["ms"].get<double>());
        if (c["chosen"].get<bool>()) {
            taken = c["ms"];
            resolution = c["resolution"];
            ++chosen;
        }
    }
    EXPECT_EQ(chosen, 1);
    EXPECT_EQ(json["families"].size(), 3u) << "all that were tried stand side by side";
    EXPECT_EQ(taken, cheapest);
    const Json again = program_json("measure boxes --preset accurate.json --size 160x90 --no-time", folder);
    EXPECT_LE(again["error"]["mae"], 0.02);
    EXPECT_EQ(again["map_resolution"], resolution);
}

}  // namespace
}  // namespace si
