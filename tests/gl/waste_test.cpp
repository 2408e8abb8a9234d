// What is simulated changes the picture somewhere, else it is waste: each map, face and cascade is left out in turn.
#include "renderer/measure/waste.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "tests/gl/frame_fixture.h"

namespace si {
namespace {

/// Of all triangles that are drawn into maps.
constexpr double kMostWaste = 0.05;

class WasteTest : public FrameTest {
protected:
    Waste waste_of(const Scene& scene, const Sets& sets) {
        return find_waste(renderer, scene, settings_for(scene, sets), {.width = 320, .height = 180});
    }
};

const Tried& tried_named(const Waste& waste, std::string_view name) {
    static const Tried none;
    for (const Tried& t : waste.tried)
        if (t.name == name) return t;
    ADD_FAILURE() << name << " was not tried";
    return none;
}

TEST_F(WasteTest, ALightThatShadowsIsNeededAndOneThatNobodySeesIsNot) {
    const Scene scene = load_scene("boxes");
    const Waste needed = waste_of(scene, {});
    EXPECT_TRUE(tried_named(needed, "map of light 0").changes);
    EXPECT_GT(tried_named(needed, "map of light 0").read, 0);
    EXPECT_GT(needed.triangles(), 0u);
    EXPECT_EQ(needed.share(), 0);
    // The camera looks away from all that there is: nothing is read of the map.
    const Waste unseen = waste_of(scene, {{"camera.source", "manual"}, {"camera.target_x", "500"}});
    EXPECT_EQ(tried_named(unseen, "map of light 0").read, 0);
    EXPECT_FALSE(tried_named(unseen, "map of light 0").changes);
    if (unseen.triangles() > 0) {
        EXPECT_EQ(unseen.share(), 1);
    }
}

TEST_F(WasteTest, WhatIsNotReadChangesNothing) {
    for (const Sets& sets : {Sets{{"light.type", "point"}}, Sets{{"light.cascades", "4"}}}) {
        const Waste waste = waste_of(load_scene("stage"), sets);
        EXPECT_GE(waste.tried.size(), 4u);
        for (const Tried& t : waste.tried)
            if (t.changes && t.read >= 0) {
                EXPECT_GT(t.read, 0) << t.name << " changes pixels, and no texel of it is read";
            }
    }
}

TEST_F(WasteTest, LeavingAMapEmptyLeavesNothingBehind) {
    const Scene scene = load_scene("boxes");
    const Settings s = settings_for(scene);
    FrameRequest request = small();
    const ByteImage before = picture(scene, s, request);
    request.emptied = MapOfLight{0, 0};
    EXPECT_GT(different_pixels(before, picture(scene, s, request)), 100u) << "the shadows are still there";
    request.emptied.reset();
    EXPECT_EQ(different_pixels(before, picture(scene, s, request)), 0u);
}

TEST_F(WasteTest, EffectsThatSettingsPutOnAreTriedToo) {
    const Scene scene = load_scene("stage");
    const Waste waste = waste_of(scene, {{"light.contact", "0.5"}, {"map.blur_texels", "2"}});
    EXPECT_TRUE(tried_named(waste, "contact shadows of light 0").changes);
    EXPECT_TRUE(tried_named(waste, "depth blur").changes);
    const Waste moments = waste_of(scene, {{"filter.kernel", "vsm"}, {"filter.blur", "3"}});
    EXPECT_TRUE(tried_named(moments, "blur of the moments").changes);
}

struct Sum {
    std::uint64_t drawn = 0, unread = 0, changes_nothing = 0;  ///< triangles; of the wasted ones: not read, and read
    std::string list;
    void add(const std::string& what, const Waste& waste) {
        drawn += waste.triangles();
        for (const Tried& t : waste.tried) {
            if (t.changes || t.triangles == 0) continue;
            (t.read > 0 ? changes_nothing : unread) += t.triangles;
            list += fmt::format("  {}: {}, {} triangles, {:.2f} % read\n", what, t.name, t.triangles, 100 * t.read);
        }
    }
    double share(std::uint64_t n) const { return drawn ? double(n) / double(drawn) : 0; }
    void print() const {
        fmt::print("of {} triangles drawn into maps {:.1f} % change nothing though read, {:.1f} % are not read:\n{}",
                   drawn, 100 * share(changes_nothing), 100 * share(unread), list);
    }
};

/// Keys of built-in scenes and paths of models.
std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const BuiltinScene& row : builtin_scenes()) names.emplace_back(row.key);
    const std::filesystem::path models = SI_SOURCE_DIR "/../shared/models";
    for (const char* folder : {"godot_room", "kaykit_graveyard", "khr_SimpleInstancing", "gen_mirrored_sheared",
                               "gen_leaf_mask_uv1", "gen_far_from_origin"}) {
        if (!std::filesystem::exists(models / folder)) continue;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(models / folder))
            if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb") {
                names.push_back(entry.path().string());
                break;
            }
    }
    return names;
}

TEST_F(WasteTest, OfMapsOverScenesAndModelsAsTheyAreIsSmall) {
    Sum sum;
    for (const std::string& name : scene_names())
        sum.add(std::filesystem::path(name).stem().string(), waste_of(load_scene(name), {}));
    sum.print();
    EXPECT_GT(sum.drawn, 0u);
    EXPECT_LE(sum.share(sum.unread + sum.changes_nothing), kMostWaste);
}

// Lights of several maps: of these there are some that nobody reads.
// Label `long`: SI_LONG=1, or ctest -L long.
TEST_F(WasteTest, OfFacesAndCascadesOverScenesAndModelsIsSmall) {
    if (!std::getenv("SI_LONG")) GTEST_SKIP() << "every scene and model under six faces and four cascades: SI_LONG=1";
    Sum sum;
    for (const std::string& name : scene_names())
        for (const Sets& sets : {Sets{{"light.type", "point"}}, Sets{{"light.cascades", "4"}}})
            sum.add(std::filesystem::path(name).stem().string() + ", " + sets[0].second,
                    waste_of(load_scene(name), sets));
    sum.print();
    EXPECT_GT(sum.drawn, 0u);
    EXPECT_LE(sum.share(sum.changes_nothing), kMostWaste);
    EXPECT_LE(sum.share(sum.unread + sum.changes_nothing), kMostWaste);
}

}  // namespace
}  // namespace si
