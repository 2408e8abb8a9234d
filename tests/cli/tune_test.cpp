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

Json measured(const fs::path& preset, const std::vector<std::string>& more = {}) {
    std::vector<std::string> args{"measure", "boxes",   "--preset",  preset.string(),
                                  "--size",  "320x180", "--no-time", "--json"};
    args.insert(args.end(), more.begin(), more.end());
    const auto r = run_program(args);
    EXPECT_EQ(r.code, 0) << r.err;
    return Json::parse(r.out, nullptr, false);
}

TEST(TuneCommand, WritesTheMinimumBiasWithoutAcne) {
    const fs::path preset = fresh_test_folder() / "least.json";
    const auto r = run_program({"tune", "boxes", "--set", "map.resolution=512", "--set", "bias.normal=0", "--set",
                                "bias.constant=0", "--size", "320x180", "-o", preset.string(), "--json"});
    ASSERT_EQ(r.code, 0) << r.err;
    const Json json = Json::parse(r.out);
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
            if (other["chosen"].get<bool>()) {
                EXPECT_LE(other["lost_px"], family["lost_px"]);
            }
        chosen += family["chosen"].get<bool>();
    }
    EXPECT_EQ(chosen, 1);
    EXPECT_EQ(json["families"].size(), 3u) << "all that were tried stand side by side";
    EXPECT_FALSE(json["settings"].contains("map.resolution"));
    const Json tuned = measured(preset)["error"];
    EXPECT_EQ(tuned["acne"], 0);
    // Acne appears with ten percent less of any active bias.
    std::vector<std::string> less;
    for (const char* key : {"bias.normal", "bias.slope", "bias.constant"})
        if (json["settings"].contains(key)) {
            less.insert(less.end(),
                        {"--set", std::string(key) + "=" + std::to_string(0.9 * json["settings"][key].get<double>())});
        }
    ASSERT_FALSE(less.empty());
    EXPECT_GT(measured(preset, less)["error"]["any_acne"], tuned["any_acne"]);
    const Json written = Json::parse(std::ifstream(preset));
    EXPECT_NE(written.dump().find("least bias without acne"), std::string::npos) << "the preset says what it is";
}

TEST(TuneCommand, UsesTheReferenceOptionsOfMeasure) {
    const fs::path preset = fresh_test_folder() / "least.json";
    const std::vector<std::string> common{"boxes", "--set", "map.resolution=512", "--size", "320x180", "--json"};
    const auto tuned = [&](const std::vector<std::string>& sets) {
        std::vector<std::string> args{"tune", "-o", preset.string()}, same{"measure", "--no-time"};
        for (auto* a : {&args, &same}) {
            a->insert(a->end(), common.begin(), common.end());
            for (const std::string& set : sets) a->insert(a->end(), {"--set", set});
        }
        const auto r = run_program(args), m = run_program(same);
        EXPECT_EQ(r.code, 0) << r.err;
        const Json before = Json::parse(r.out)["before"]["error"], error = Json::parse(m.out)["error"];
        for (const char* key : {"pixels", "mae", "false_shadow", "boundary_px_mean"})
            EXPECT_EQ(before[key], error[key]) << key;
        return before;
    };
    const int all = tuned({})["pixels"]["counted"], some = tuned({"truth.step=4"})["pixels"]["counted"];
    EXPECT_NEAR(double(some) / all, 1.0 / 16, 0.01);
    tuned({"truth.area=true", "light.size=3", "truth.samples=16", "truth.noise=0.1", "truth.step=3"});
}

SI_TEST_IS(Long, TuneCommand, StaysWithinTheRequestedError);  // compiles and times all kernels of three families
TEST(TuneCommand, StaysWithinTheRequestedError) {
    const fs::path preset = fresh_test_folder() / "accurate.json";
    const auto r =
        run_program({"tune", "boxes", "--max-error", "0.02", "--size", "160x90", "-o", preset.string(), "--json"});
    ASSERT_EQ(r.code, 0) << r.err;
    const Json json = Json::parse(r.out);
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
    const auto again =
        run_program({"measure", "boxes", "--preset", preset.string(), "--size", "160x90", "--no-time", "--json"});
    EXPECT_LE(Json::parse(again.out)["error"]["mae"], 0.02);
    EXPECT_EQ(Json::parse(again.out)["map_resolution"], resolution);
}

TEST(TuneCommand, RefusesWrongArguments) {
    const fs::path folder = fresh_test_folder();
    const std::string preset = (folder / "p.json").string();
    const auto refused = [&](std::vector<std::string> args, int code, const std::string& about) {
        args.insert(args.begin(), "tune");
        const auto r = run_program(args);
        EXPECT_EQ(r.code, code) << r.err;
        EXPECT_NE(r.err.find(about), std::string::npos) << r.err;
        EXPECT_FALSE(fs::exists(preset)) << "nothing is written";
    };
    refused({"boxes"}, 2, "-o");
    refused({"boxes", "-o", (folder / "p.txt").string()}, 2, ".json");
    refused({"boxes", "-o", preset, "--max-error", "0"}, 2, "--max-error: \"0\" is not a number above 0");
    refused({"boxes", "-o", preset, "--max-ms", "inf"}, 2, "\"inf\" is not a number above 0");
    refused({"boxes", "-o", preset, "--max-ms", "soon"}, 2, "--max-ms");
    refused({"boxes", "-o", preset, "--error", "prettiness"}, 2, "it is one of mae");
    refused({"boxes", "-o", preset, "--set", "light.cast=false"}, 1, "no bias to find");
    refused({"boxes", "-o", (folder / "none" / "p.json").string()}, 1, "none");
}

}  // namespace
}  // namespace si
