// Tests of casters that face culling removes from a map.
#include "renderer/inspect/lost_casters.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/base/angles.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/sets.h"

namespace si {
namespace {

Mesh quad() {  // faces +y
    Mesh mesh;
    mesh.positions = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

Mesh closed_box() {
    Mesh mesh;
    for (int i = 0; i < 8; ++i) mesh.positions.push_back({i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1});
    mesh.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    return mesh;
}

/// Makes a floor and a closed box above it, each under a transform of its own.
Scene floor_and_box(const glm::dmat4& floor = glm::dmat4(1), const glm::dmat4& box = glm::dmat4(1)) {
    Scene scene;
    scene.meshes = {quad(), closed_box()};
    scene.nodes = {{.name = "Floor", .local = floor},
                   {.name = "Box", .local = glm::translate(glm::dmat4(1), {0, 3, 0}) * box}};
    scene.objects = {{.node = 0, .mesh = 0}, {.node = 1, .mesh = 1}};
    finalise(scene);
    return scene;
}

Settings with_cull(Cull cull) {
    Settings s;
    s.caster.cull = cull;
    return s;
}

std::vector<LostCaster> lost_casters_of(const Scene& scene, const Settings& settings) {
    return lost_casters(scene, settings, fit_lights(scene, settings).front());
}

TEST(LostCasters, NoCullingLosesNothing) {
    EXPECT_TRUE(lost_casters_of(floor_and_box(), with_cull(Cull::None)).empty());
}

TEST(LostCasters, FrontCullingLosesTheFloorAndKeepsTheClosedBox) {
    const Scene scene = floor_and_box();
    const auto list = lost_casters_of(scene, with_cull(Cull::Front));
    ASSERT_EQ(list.size(), 1u);
    EXPECT_EQ(list[0].object, 0);
    EXPECT_EQ(list[0].triangles, 2u);
    const auto notes = lost_caster_remarks(scene, list, 0);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes[0].find("object.Floor.cull=none"), std::string::npos) << notes[0];
}

TEST(LostCasters, BackCullingLosesOnlyAFloorSeenFromBelow) {
    EXPECT_TRUE(lost_casters_of(floor_and_box(), with_cull(Cull::Back)).empty());
    const auto turned = glm::rotate(glm::dmat4(1), 180 * kDegree, {1, 0, 0});
    ASSERT_EQ(lost_casters_of(floor_and_box(turned), with_cull(Cull::Back)).size(), 1u);
}

TEST(LostCasters, MirroringAndUnevenScaleChangeNothing) {
    const auto mirrored = glm::scale(glm::dmat4(1), {-3, 0.2, 5});
    const auto list = lost_casters_of(floor_and_box(mirrored, mirrored), with_cull(Cull::Front));
    ASSERT_EQ(list.size(), 1u);
    EXPECT_EQ(list[0].object, 0);
}

TEST(LostCasters, SpotLightsUseTheirPosition) {
    Settings s = settings_with(with_cull(Cull::Back), {"light.type=spot", "light.elevation=60"});
    EXPECT_TRUE(lost_casters_of(floor_and_box(), s).empty());
    s.lights[0].elevation = -60;  // below the floor
    const auto list = lost_casters_of(floor_and_box(), s);
    ASSERT_EQ(list.size(), 1u);
    EXPECT_EQ(list[0].object, 0);
}

TEST(LostCasters, BlendedMaterialsCastNothingByDefault) {
    Scene scene = floor_and_box();
    scene.materials = {{.name = "Glass", .alpha = AlphaMode::Blend}};
    scene.meshes[1].material = 0;
    Settings s;
    const auto list = lost_casters_of(scene, s);
    ASSERT_EQ(list.size(), 1u);
    EXPECT_EQ(list[0].object, 1);
    EXPECT_EQ(list[0].by, LostBy::Blending);
    EXPECT_NE(lost_caster_text(scene, list[0], 0).find("caster.blend=mask"), std::string::npos);
    s.caster.blend = BlendCasters::Mask;
    EXPECT_TRUE(lost_casters_of(scene, s).empty());
}

TEST(LostCasters, TheNearPlaneLosesWhatLiesBeforeIt) {
    const Scene scene = floor_and_box();
    Settings s = settings_with({}, {"light.elevation=90", "light.fit=manual", "light.distance=10", "light.extent=5",
                                    "light.near_far=manual", "light.near=11", "light.far=30"});
    auto list = lost_casters_of(scene, s);
    ASSERT_EQ(list.size(), 1u);
    EXPECT_EQ(list[0].object, 1);
    EXPECT_EQ(list[0].by, LostBy::NearPlane);
    EXPECT_NE(lost_caster_text(scene, list[0], 2).find("light.2.near_far=fitted"), std::string::npos);
    s.lights[0].near = 1;
    EXPECT_TRUE(lost_casters_of(scene, s).empty());
}

TEST(LostCasters, ThoseBeforeAPointAreFoundByRays) {
    const Scene scene = floor_and_box();
    const Settings s = settings_with(with_cull(Cull::Front), {"light.elevation=90"});
    const FittedLight light = fit_lights(scene, s).front();
    const std::vector<LostCaster> both = {{.object = 0}, {.object = 1}};
    const auto before = lost_casters_before(scene, both, light, {0.5, 0.5, 0.5});
    ASSERT_EQ(before.size(), 1u);
    EXPECT_EQ(before[0].object, 1) << "the floor lies behind the point";
    EXPECT_TRUE(lost_casters_before(scene, both, light, {1.5, 0.5, 0.5}).empty()) << "beside the box";
}

TEST(LostCasters, ObjectOverridesCount) {
    Settings s = with_cull(Cull::Front);
    s.objects["Floor"].cull = ObjectCull::None;
    EXPECT_TRUE(lost_casters_of(floor_and_box(), s).empty());
    s.objects["Floor"] = {.cast = false};
    EXPECT_TRUE(lost_casters_of(floor_and_box(), s).empty());
    Settings own = with_cull(Cull::None);
    own.objects["Floor"].cull = ObjectCull::Front;
    EXPECT_EQ(lost_casters_of(floor_and_box(), own).size(), 1u);
}

}  // namespace
}  // namespace si
