// Tests of troubles that users reported, rebuilt as small scenes (tests/data/field): what the program says of each, and
// that its fix puts the picture right.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

using Json = nlohmann::json;

Words field(const std::string& scene) {
    return {(std::filesystem::path(SI_SOURCE_DIR) / "tests/data/field" / (scene + ".glb")).string()};
}

/// Probes a pixel. Expects its remedy to be a fix of the list.
Json probe(const Words& scene, const Words& more) {
    const Json json = program_json("probe" + scene + "--size 640x360" + more);
    const Json& remedy = json["lights"][0]["dossier"]["remedy"];
    if (!remedy.is_null()) {
        EXPECT_TRUE(json["cures"][0]["fix"].get<bool>());
        EXPECT_TRUE(json["cures"][0]["pixel_right"].get<bool>());
        EXPECT_EQ(remedy["settings"], json["cures"][0]["settings"]);
    }
    return json;
}
std::string verdict(const Json& probed) {
    return probed["lights"][0]["dossier"]["verdict"];
}
bool says(const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
}

TEST(FieldReports, FacesThatAreNotInTheMapNeedNoBias) {
    const std::filesystem::path folder = fresh_test_folder();
    const Json tuned = program_json(
        "tune boxes --size 160x90 --set map.resolution=512 --set caster.cull=front --set bias.kind=constant --set "
        "bias.constant=0 --set bias.normal=0 --set filter.kernel=pcf3 -o none.json",
        folder);
    for (const Json& row : tuned["biases"])
        if (row["chosen"].get<bool>()) {
            EXPECT_LE(row["wrong_px"], tuned["before"]["wrong_px"]);
            EXPECT_LE(row["score"], tuned["before"]["score"]);
        }
}

SI_TEST_IS(Slow, FieldReports, ACulledCardIsNamedAndItsFixBreaksNothing);
TEST(FieldReports, ACulledCardIsNamedAndItsFixBreaksNothing) {
    const Json card =
        probe(field("card"),
              "--pixel 320,207 --set map.resolution=1024 --set caster.cull=front --set bias.kind=constant "
              "--set bias.constant=0 --set bias.normal=0");
    EXPECT_TRUE(says(verdict(card), "Card")) << verdict(card);
    EXPECT_TRUE(says(verdict(card), "culling")) << verdict(card);
    ASSERT_FALSE(card["lights"][0]["dossier"]["remedy"].is_null());
    EXPECT_LT(card["cures"][0]["broken_px"], card["cures"][0]["cured_px"].get<int>() / 20);
}

SI_TEST_IS(Later, FieldReports, ACasterBeforeTheNearPlaneIsNamedWithAFix);
TEST(FieldReports, ACasterBeforeTheNearPlaneIsNamedWithAFix) {
    const Json crate =
        probe(field("crate"),
              "--pixel 391,194 --set light.near_far=manual --set light.distance=50 --set light.near=49.5 "
              "--set light.far=70");
    EXPECT_TRUE(says(verdict(crate), "near plane")) << verdict(crate);
    const Json& remedy = crate["lights"][0]["dossier"]["remedy"];
    ASSERT_FALSE(remedy.is_null());
    EXPECT_TRUE(says(remedy["key"].get<std::string>(), "near")) << remedy;
}

TEST(FieldReports, ASmoothBodysFacetIsAShadowTerminator) {
    const Json ball = probe(field("ball"), "--pixel 271,110");
    EXPECT_TRUE(says(verdict(ball), "shadow terminator")) << verdict(ball);
    EXPECT_TRUE(says(verdict(ball), "no bias cures it")) << verdict(ball);
    EXPECT_FALSE(says(verdict(ball), "dark without a map")) << "it is bright";
}

TEST(FieldReports, VarianceOfALongRangeBleeds) {
    const Json bim = program_json(
        "measure" + field("bim") +
        "--no-time --size 320x180 --set light.distance=5000 --set light.near=250 --set light.far=19998 --set "
        "light.fit=manual --set filter.kernel=vsm");
    EXPECT_GT(bim["error"]["artefacts"]["light_bleeding"], 100);
    EXPECT_EQ(bim["error"]["artefacts"]["leak"], 0);
}

SI_TEST_IS(Later, FieldReports, WhatCastsNothingAndWhatHasNoEffectIsSaid);
TEST(FieldReports, WhatCastsNothingAndWhatHasNoEffectIsSaid) {
    const ProcessResult leaf = run_program("measure" + field("leaf") + "--no-time --size 160x90");
    EXPECT_TRUE(says(leaf.err, "LeavesBlend casts no shadow: its material blends")) << leaf.err;
    const ProcessResult room =
        run_program("measure" + field("room") + "--no-time --size 160x90 --set light.type=point --set map.wrap=clamp");
    EXPECT_TRUE(says(room.err + room.out, "map.wrap")) << room.err;
}

}  // namespace
}  // namespace si
