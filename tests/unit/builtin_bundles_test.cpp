// Tests of the bundles that the program computes: each reads without a note, and their names are no paths.
#include "renderer/bundle/builtin_bundles.h"

#include <gtest/gtest.h>

#include "app/session/presets.h"
#include "renderer/bundle/bundle_files.h"
#include "renderer/bundle/given_maps.h"
#include "renderer/settings/param.h"
#include "tests/support/error_text.h"
#include "tests/unit/gltf_test_file.h"

namespace si {
namespace {

TEST(BuiltinBundles, EachReadsWithoutANote) {
    const struct {
        const char* name;
        int width, height;
        bool perspective, reversed;
    } bundles[] = {{"builtin:strip", 128, 512, false, false},   {"builtin:warped", 256, 256, false, false},
                   {"builtin:reversed", 512, 512, true, true},  {"builtin:reversed-unstated", 512, 512, true, false},
                   {"builtin:16-bits", 512, 512, true, false},  {"builtin:relative-to-camera", 512, 512, false, false},
                   {"builtin:absolute", 512, 512, false, false}};
    for (const auto& b : bundles) {
        SCOPED_TRACE(b.name);
        const auto given = given_maps(b.name);
        EXPECT_TRUE(given->notes.empty()) << given->notes.front();
        EXPECT_TRUE(given->files.empty());
        const ImportedMaps& maps = *given->lights.at(0);
        EXPECT_TRUE(maps.bias_known);
        EXPECT_EQ(maps.size().width, b.width);
        EXPECT_EQ(maps.size().height, b.height);
        const LightView& view = maps.views->views.at(0);
        EXPECT_EQ(view.curve.perspective, b.perspective);
        EXPECT_EQ(view.curve.convention.reversed, b.reversed);
        const BundleFiles files(b.name);
        EXPECT_TRUE(files.has(kFrameJson) && files.has("map.raw") && !files.has("scene.glb"));
    }
}

TEST(BuiltinBundles, UnknownNamesAreRefused) {
    EXPECT_TRUE(test::mentions(test::error_text([] { given_maps("builtin:strop"); }),
                               {"builtin:strop", "no such built-in bundle", "strip"}));
    EXPECT_FALSE(is_builtin_bundle("frame.bundle"));
    EXPECT_FALSE(is_builtin_bundle("folder/builtin:strip"));
    BundleFiles files("builtin:strip");
    EXPECT_TRUE(test::mentions(test::error_text([&] { files.read("other", 1000); }), {"other", "does not exist"}));
    EXPECT_TRUE(test::mentions(test::error_text([&] { files.read("../map.raw", 1000); }), {"has .."}));
}

TEST(BuiltinBundles, PresetsKeepTheName) {
    const test::TemporaryFolder folder;
    Preset preset;
    set_setting(preset.settings, "map.bundle", "builtin:strip");
    save_preset(preset, folder.path() / "given.json");
    EXPECT_EQ(load_preset((folder.path() / "given.json").string()).settings.map.bundle, "builtin:strip");
}

}  // namespace
}  // namespace si
