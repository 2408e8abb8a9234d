// Tests of fixes on the command line: a row's settings, given to `measure`, cure and break exactly the reported number
// of pixels.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/process.h"

namespace si {
namespace {

using Json = nlohmann::json;

const std::vector<std::string> kScene{"boxes",         "--set", "map.resolution=512", "--set",
                                      "bias.normal=0", "--set", "bias.constant=0",    "--size",
                                      "320x180",       "--json"};

Json run(const char* command, std::vector<std::string> more) {
    std::vector<std::string> args{command};
    args.insert(args.end(), kScene.begin(), kScene.end());
    args.insert(args.end(), more.begin(), more.end());
    const auto r = run_program(args);
    EXPECT_EQ(r.code, 0) << r.err;
    return Json::parse(r.out, nullptr, false);
}

long long wrong_pixel_count(const Json& measured) {
    long long n = 0;
    for (const auto& [cause, pixels] : measured["error"]["artefacts"].items())
        if (cause != "none") n += pixels.get<long long>();
    return n;
}

TEST(FixesInJson, AreNullUnlessRequestedAndReachTheirFigures) {
    EXPECT_TRUE(run("measure", {"--no-time"})["cures"].is_null());
    const Json all = run("measure", {"--no-time", "--cures"});
    ASSERT_TRUE(all["cures"].is_array());
    const Json& first = all["cures"][0];
    EXPECT_GT(first["cured_px"], 1000);
    EXPECT_TRUE(first["ms"].is_null()) << "nothing was timed";
    std::vector<std::string> sets{"--no-time"};
    for (const auto& [key, value] : first["settings"].items()) {
        sets.push_back("--set");
        sets.push_back(key + "=" + value.get<std::string>());
    }
    EXPECT_EQ(wrong_pixel_count(run("measure", sets)),
              wrong_pixel_count(all) - first["cured_px"].get<long long>() + first["broken_px"].get<long long>());
}

TEST(FixesInJson, CureTheProbedPixel) {
    for (int x = 60; x < 260; x += 7) {
        const Json probe = run("probe", {"--pixel", std::to_string(x) + ",120"});
        ASSERT_TRUE(probe["hit"].is_boolean());
        if (!probe["hit"].get<bool>()) continue;
        const std::string artefact = probe["lights"][0]["dossier"]["artefact"];
        ASSERT_TRUE(probe["cures"].is_array());
        if (artefact == "none") {
            EXPECT_TRUE(probe["cures"].empty()) << "nothing is wrong";
            continue;
        }
        ASSERT_FALSE(probe["cures"].empty());
        EXPECT_TRUE(probe["cures"][0]["pixel_right"].get<bool>());
        EXPECT_TRUE(probe["cures"][0]["ms"].is_object());
        std::vector<std::string> sets{"--pixel", std::to_string(x) + ",120"};
        for (const auto& [key, value] : probe["cures"][0]["settings"].items()) {
            sets.push_back("--set");
            sets.push_back(key + "=" + value.get<std::string>());
        }
        EXPECT_EQ(run("probe", sets)["lights"][0]["dossier"]["artefact"], "none");
        return;
    }
    ADD_FAILURE() << "no pixel with acne was met";
}

}  // namespace
}  // namespace si
