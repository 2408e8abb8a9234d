// Tests of the main part of a scene: first pictures that leave out what lies far off, and scenes that look z-up.
#include "renderer/scene/main_part.h"

#include <gtest/gtest.h>

#include "app/session/session.h"
#include "renderer/gltf/gltf.h"
#include "renderer/scene/animation.h"
#include "renderer/scenes/shapes.h"
#include "renderer/view/cameras/make_camera.h"
#include "tests/unit/gltf_test_file.h"

namespace si::test::main_part {
namespace {

/// Returns a scene of boxes: sizes and centres, metres.
Scene boxes(std::initializer_list<std::pair<glm::dvec3, glm::dvec3>> list) {
    Scene scene = named_scene("boxes", "");
    for (const auto& [size, at] : list) add_shape(scene, "Box", -1, make_box(size), -1, moved(at.x, at.y, at.z));
    return finished(std::move(scene));
}

/// Returns a scene after it was written to a file, read and posed.
Scene loaded(const Scene& scene) {
    const TemporaryFolder folder;
    save_gltf(scene, folder.path() / "scene.glb");
    Scene out = load_gltf(folder.path() / "scene.glb");
    pose_scene(out, {});
    return out;
}

/// Returns two boxes on a slab of 10 m, and a small box `away_m` along x.
Scene with_far_box(double away_m) {
    return boxes({{{10, 0.25, 10}, {0, 0, 0}},
                  {{2, 4, 2}, {-1, 2, 0}},
                  {{0.5, 1, 0.5}, {3, 0.5, 2}},
                  {{0.02, 0.02, 0.02}, {away_m, 0, 0}}});
}

TEST(MainPart, HoldsAllUnlessAnAxisIsTwentyTimesAsLong) {
    EXPECT_TRUE(with_far_box(150).main_part.empty());
    const Scene far = with_far_box(1e6);
    EXPECT_EQ(far.main_part, (Bounds{{-5, -0.125, -5}, {5, 4, 5}}));
    EXPECT_EQ(main_bounds(far), far.main_part);
    EXPECT_EQ(main_bounds(with_far_box(150)), with_far_box(150).bounds);
    // A thin mast is no reason: the scene is as long as its ground is wide.
    EXPECT_TRUE(boxes({{{100, 0.1, 100}, {0, 0, 0}}, {{0.1, 100, 0.1}, {0, 50, 0}}}).main_part.empty());
    EXPECT_TRUE(boxes({}).main_part.empty());
    EXPECT_TRUE(boxes({{{1, 1, 1}, {0, 0, 0}}}).main_part.empty());
}

TEST(MainPart, LeavesOutAStrayVertexOfAMesh) {
    Mesh ball = make_sphere(1, 32, 16);
    ball.positions.edit()[7].y = -3e5f;
    Scene scene = named_scene("ball", "");
    add_shape(scene, "Ball", -1, std::move(ball), -1);
    scene = finished(std::move(scene));
    ASSERT_FALSE(scene.main_part.empty());
    EXPECT_NEAR(scene.main_part.lo.y, -1, 0.1);
    EXPECT_EQ(far_objects_text(scene), "node 'Ball' reaches 3e+05 m from the rest");
}

TEST(MainPart, CountsFineObjectsAndWeighsLargeOnes) {
    // A sky of few large triangles around a fine ball: the ball has most corners.
    Scene sky = named_scene("sky", "");
    add_shape(sky, "Ball", -1, make_sphere(1, 96, 48), -1);
    add_shape(sky, "Sky", -1, make_box({1000, 1000, 1000}), -1);
    sky = finished(std::move(sky));
    ASSERT_FALSE(sky.main_part.empty());
    EXPECT_EQ(far_objects_text(sky), "node 'Sky' reaches 497 m from the rest");
    // A speck with a quarter of the corners: the room has most of the area.
    EXPECT_EQ(far_objects_text(with_far_box(1e4)), "node 'Box #4' reaches 1e+04 m from the rest");
}

TEST(MainPart, FirstPictureFramesItAndTheNoteNamesTheRest) {
    const Scene near = loaded(with_far_box(7)), far = loaded(with_far_box(-1e6));
    EXPECT_FALSE(mentions(near.warnings, "from the rest"));
    EXPECT_TRUE(mentions(far.warnings,
                         "node 'Box #4' reaches 1e+06 m from the rest; the first picture frames the rest, and "
                         "light.fit starts as view; camera.index=-1 frames all"))
        << testing::PrintToString(far.warnings);
    const Settings settings = base_settings(far);
    EXPECT_EQ(settings.lights[0].fit, LightFit::View);
    EXPECT_EQ(base_settings(near).lights[0].fit, LightSettings{}.fit);
    const Camera first = make_camera(far, settings, 16.0 / 9), usual = make_camera(near, base_settings(near), 16.0 / 9);
    EXPECT_NEAR(first.focus, usual.focus, 0.3 * usual.focus);
    EXPECT_LT(glm::distance(first.eye, main_bounds(far).centre()), 40);
    EXPECT_GT(first.curve.far, 4e5) << "what is far is drawn";
    EXPECT_LT(first.curve.near, 0.9 * first.focus);
    Settings all = settings;
    all.camera.index = -1;
    EXPECT_GT(make_camera(far, all, 16.0 / 9).focus, 5e5);
    EXPECT_EQ(make_camera(near, all, 16.0 / 9).focus, usual.focus);
}

TEST(MainPart, AnimatedFilesWithLightsKeepTheirFit) {
    Scene lit = with_far_box(-1e6);
    lit.lights.push_back({.name = "Sun"});
    Scene scene = loaded(lit);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(base_settings(scene).lights[0].fit, LightFit::View);
    auto rig = std::make_shared<Rig>();
    rig->animations.emplace_back();
    scene.rig = std::move(rig);
    pose_scene(scene, {});
    const Settings posed = base_settings(scene);
    EXPECT_EQ(posed.lights[0].fit, LightFit::View);
    EXPECT_EQ(posed.light_count, 1);
}

TEST(MainPart, TheGroundLiesUnderIt) {
    const auto cube_and = [](double away_m) {
        return loaded(boxes({{{2, 2, 2}, {0, 1, 0}}, {{0.01, 0.01, 0.01}, {0, 1, away_m}}}));
    };
    const Bounds near = cube_and(0).ground_bounds, far = cube_and(1e6).ground_bounds;
    ASSERT_FALSE(far.empty());
    EXPECT_NEAR(far.hi.y, near.hi.y, 1e-6);
    EXPECT_NEAR(far.hi.x - far.lo.x, near.hi.x - near.lo.x, 1e-3);
}

TEST(MainPart, CameraKeepsSmallThingsBeforeItsNearPlane) {
    const Scene scene = loaded(boxes({{{0.1, 0.1, 0.1}, {0, 0, 0}}, {{0.001, 0.001, 0.001}, {1e6, 0, 0}}}));
    const Camera camera = make_camera(scene, base_settings(scene), 1);
    EXPECT_LT(camera.curve.near, glm::distance(camera.eye, glm::dvec3(0)) - 0.1);
}

TEST(LooksZUp, IsAskedOfLowScenesThatStandOnAPlaneAlongZ) {
    const auto standing = [](bool z_up) {
        const auto at = [&](double x, double up, double y) {
            return z_up ? glm::dvec3(x, -y, up) : glm::dvec3(x, up, y);
        };
        return boxes({{glm::abs(at(2, 12, 2)), at(0, 6, 0)},
                      {glm::abs(at(1, 9, 1)), at(1, 4.5, 1)},
                      {glm::abs(at(1, 1, 1)), at(-1, 8, 0)}});
    };
    EXPECT_TRUE(looks_z_up(standing(true)));
    EXPECT_FALSE(looks_z_up(standing(false)));
    EXPECT_FALSE(looks_z_up(boxes({})));
    EXPECT_FALSE(looks_z_up(boxes({{{10, 0, 10}, {0, 0, 0}}}))) << "a floor";
    EXPECT_TRUE(looks_z_up(boxes({{{10, 1, 1}, {0, 0.5, 0}}, {{1, 1, 9}, {0, 0.5, 4}}}))) << "two low walls";
    EXPECT_FALSE(looks_z_up(boxes({{{10, 1, 1}, {0, 0.5, 0}}, {{1, 1, 9}, {0, 0.5, 4}}, {{10, 0, 10}, {0, 0, 4}}})))
        << "two low walls on a floor";
    const Scene scene = loaded(standing(true));
    EXPECT_TRUE(scene.looks_z_up);
    EXPECT_TRUE(mentions(scene.warnings, "the scene looks z-up")) << testing::PrintToString(scene.warnings);
    EXPECT_FALSE(loaded(standing(false)).looks_z_up);
}

}  // namespace
}  // namespace si::test::main_part
