// Savings are proved both ways: what is forced draws the same bytes, and counts say that what is saved was not done.
#include "renderer/frame/savings.h"

#include <filesystem>

#include "tests/gl/frame_fixture.h"

namespace si {
namespace {

class SavingsTest : public FrameTest {
protected:
    /// Every picture of a frame that is saved on, and of one that forces a row, must be the same.
    void expect_one_picture(const Scene& scene, const Sets& extra, const std::string& what) {
        const Settings s = settings_for(scene, extra);
        FrameRequest cold{.width = 160, .height = 90}, maps = cold;
        // Some savings are made on maps that are kept; of those that are forced every map is drawn anew.
        maps.outputs = {.colour = false, .shadow_map = true};
        renderer.render(scene, s, maps);
        const ByteImage saved = picture(scene, s, cold);
        for (std::size_t row = 0; row < kSavings; ++row) {
            FrameRequest request = cold;
            request.forced = {Saving(row)};
            EXPECT_EQ(different_pixels(saved, picture(scene, s, request)), 0u)
                << what << ", " << savings()[row].key << " forced";
        }
    }
};

/// Of lights, kernels and maps what decides which savings can be made.
const std::vector<Sets>& cases() {
    static const std::vector<Sets> all = {
        {},
        {{"light.type", "spot"}},
        {{"light.type", "point"}, {"filter.kernel", "pcf3"}},
        {{"light.cascades", "4"}, {"filter.kernel", "pcf5"}},
        {{"filter.kernel", "pcss"}, {"filter.taps", "32"}, {"filter.blocker_taps", "32"}},
        {{"filter.kernel", "vsm"}},
        {{"map.virtual", "true"}},
        {{"shading.separate_visibility", "true"}, {"light.cast", "false"}},
    };
    return all;
}

TEST_F(SavingsTest, ForcedDrawsTheSameBytesInEveryBuiltInScene) {
    std::size_t next = 1;
    for (const BuiltinScene& row : builtin_scenes()) {
        const Scene scene = load_scene(std::string(row.key));
        expect_one_picture(scene, cases()[0], std::string(row.key));
        // By turns: each scene meets two, each is met by several scenes.
        for (int i = 0; i < 2; ++i, next = next % (cases().size() - 1) + 1)
            expect_one_picture(scene, cases()[next], std::string(row.key) + ", " + cases()[next][0].second);
    }
}

TEST_F(SavingsTest, ForcedDrawsTheSameBytesOfRealModels) {
    const std::filesystem::path models = SI_SOURCE_DIR "/../shared/models";
    if (!std::filesystem::exists(models)) GTEST_SKIP() << "../shared/models is not here";
    for (const char* file : {"godot_room", "kaykit_graveyard", "khr_SimpleInstancing", "gen_mirrored_sheared",
                             "gen_leaf_mask_uv1", "gen_far_from_origin"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(models / file)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".gltf" && extension != ".glb") continue;
            const Scene scene = load_scene(entry.path().string());
            for (const Sets& sets : {cases()[0], cases()[1], cases()[3]}) expect_one_picture(scene, sets, file);
            break;
        }
    }
}

}  // namespace
}  // namespace si
