// Tests of glTF extras: exported ones are read back, and foreign ones do no harm.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/scenes/builtin.h"
#include "tests/unit/gltf_test_file.h"

namespace si::test {
namespace {

TEST(GltfExtras, BuiltInScenesKeepTheirSentenceSuggestionsAndCameras) {
    const TemporaryFolder folder;
    for (const BuiltinScene& row : builtin_scenes()) {
        const Scene scene = load_scene(row.key);
        const auto file = folder.path() / (std::string(row.key) + ".glb");
        save_gltf(scene, file);
        const Scene again = load_gltf(file);
        EXPECT_TRUE(again.warnings.empty()) << row.key << ": " << again.warnings.front();
        EXPECT_EQ(again.about, scene.about) << row.key;
        EXPECT_EQ(again.suggested, scene.suggested) << row.key;
        ASSERT_EQ(again.cameras.size(), scene.cameras.size()) << row.key;
        for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
            EXPECT_NEAR(again.cameras[i].near, scene.cameras[i].near, 1e-9) << row.key;
            EXPECT_NEAR(again.cameras[i].far, scene.cameras[i].far, 1e-6) << row.key;
        }
    }
}

TEST(GltfExtras, FilesOfSettingsAreNotExported) {
    const TemporaryFolder folder;
    const Scene scene = load_scene("hard/given-strip");
    const auto has_bundle = [](const Scene& s) {
        return std::ranges::any_of(s.suggested, [](const auto& row) { return row.first == "map.bundle"; });
    };
    ASSERT_TRUE(has_bundle(scene));
    save_gltf(scene, folder.path() / "given.glb");
    const Scene again = load_gltf(folder.path() / "given.glb");
    EXPECT_TRUE(again.warnings.empty()) << again.warnings.front();
    EXPECT_FALSE(has_bundle(again));
    EXPECT_EQ(again.suggested.size() + 1, scene.suggested.size());
}

std::filesystem::path with_extras(const TemporaryFolder& folder, const Json& extras) {
    const Json root = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"extras", extras}}}}};
    return folder.write("extras.gltf", root.dump());
}

TEST(GltfExtras, ForeignAndHostileExtrasAreOnlyWarnings) {
    const TemporaryFolder folder;
    for (const Json& foreign : {Json("text"), Json(7), Json::array({1, 2}), Json{{"about", 3}},
                                Json{{"shadow_inspector", "text"}}, Json{{"shadow_inspector", {{"about", {1, 2}}}}}}) {
        const Scene scene = load_gltf(with_extras(folder, foreign));
        EXPECT_TRUE(scene.suggested.empty()) << foreign;
        EXPECT_NE(scene.about.find("glTF"), std::string::npos) << foreign;
    }
    const Json own = {
        {"suggested", {{"bias.constant", "2"}, {"bias.constnat", "2"}, {"bias.slope", 7}, {"map.resolution", "huge"}}},
        {"about", "one\x1b[2J"}};
    const Scene scene = load_gltf(with_extras(folder, {{"shadow_inspector", own}}));
    ASSERT_EQ(scene.suggested.size(), 1u);
    EXPECT_EQ(scene.suggested[0], std::pair(std::string("bias.constant"), std::string("2")));
    std::size_t warnings_found = 0;
    for (const std::string& warning : scene.warnings)
        warnings_found += warning.find("suggested setting") != std::string::npos;
    EXPECT_EQ(warnings_found, 3u);
    EXPECT_EQ(scene.about.find('\x1b'), std::string::npos) << "control characters are made visible";
}

}  // namespace
}  // namespace si::test
