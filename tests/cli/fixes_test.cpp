// Tests of fixes on the command line: a row's settings, given to `measure`, cure and break exactly the reported number
// of pixels.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/process.h"

namespace si {
namespace {

using Json = nlohmann::json;

Json run(const char* command, const Words& more) {
    return program_json(command +
                        Words("boxes --set map.resolution=512 --set bias.kind=constant --set bias.normal=0 --set "
                              "bias.constant=0 --size 320x180") +
                        more);
}

long long wrong_pixel_count(const Json& measured) {
    long long n = 0;
    for (const auto& [cause, pixels] : measured["error"]["artefacts"].items())
        if (cause != "none") n += pixels.get<long long>();
    return n;
}

TEST(FixesInJson, AreNullUnlessRequestedAndReachTheirFigures) {
    EXPECT_TRUE(run("measure", "--no-time")["cures"].is_null());
    const Json all = run("measure", "--no-time --cures");
    ASSERT_TRUE(all["cures"].is_array());
    const Json& first = all["cures"][0];
    EXPECT_GT(first["cured_px"], 1000);
    EXPECT_TRUE(first["fix"].get<bool>());
    EXPECT_TRUE(first["ms"].is_object()) << "the price of a fix is known";
    EXPECT_LT(first["error"]["after"], first["error"]["before"]);
    for (const Json& row : all["cures"])
        if (row["tried"].get<bool>()) {
            EXPECT_EQ(row["fix"].get<bool>(), row["why_not"].is_null());
        }
    EXPECT_EQ(wrong_pixel_count(run("measure", "--no-time" + set_words(first["settings"]))),
              wrong_pixel_count(all) - first["cured_px"].get<long long>() + first["broken_px"].get<long long>());
}

TEST(FixesInJson, CureTheProbedPixel) {
    for (int x = 60; x < 260; x += 7) {
        const Words pixel = "--pixel " + std::to_string(x) + ",120";
        const Json probe = run("probe", pixel);
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
        EXPECT_TRUE(probe["cures"][0]["fix"].get<bool>());
        EXPECT_EQ(probe["lights"][0]["dossier"]["remedy"]["settings"], probe["cures"][0]["settings"]);
        EXPECT_TRUE(probe["cures"][0]["ms"].is_object());
        const Json cured = run("probe", pixel + set_words(probe["cures"][0]["settings"]));
        EXPECT_EQ(cured["lights"][0]["dossier"]["artefact"], "none");
        return;
    }
    ADD_FAILURE() << "no pixel with acne was met";
}

}  // namespace
}  // namespace si
