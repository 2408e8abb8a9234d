// Tests of placed scenes and of settings that move with them.
#include "renderer/scene/placement.h"

#include <gtest/gtest.h>

#include "app/session/command_line.h"
#include "app/session/session.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"
#include "renderer/view/cameras/make_camera.h"
#include "tests/unit/gltf_test_file.h"

namespace si {
namespace {

Session placed_session(const std::vector<std::string>& sets) {
    return open_session({.scene = "boxes", .sets = sets});
}

TEST(Placement, MovesAndScalesTheWholeScene) {
    Scene scene = placed_session({}).scene;
    const Bounds home = scene.bounds;
    const std::uint64_t id = scene.id;
    SceneSettings far{.distance = 1e6, .direction = PlacedAlong::X, .scale = 100};
    pose_scene(scene, far);
    EXPECT_NE(scene.id, id);
    EXPECT_NEAR(scene.bounds.centre().x, 1e6 + 100 * home.centre().x, 1e-6);
    EXPECT_NEAR(scene.bounds.radius(), 100 * home.radius(), 1e-6);
    pose_scene(scene, far);  // a second call does not move the scene again
    EXPECT_NEAR(scene.bounds.radius(), 100 * home.radius(), 1e-6);
    pose_scene(scene, {});
    EXPECT_EQ(scene.bounds.lo, home.lo);
    EXPECT_EQ(scene.bounds.hi, home.hi);
}

TEST(Placement, MovesCamerasAndLightsOfTheScene) {
    Scene scene;
    scene.cameras.push_back({.name = "c"});
    scene.lights.push_back({.name = "l"});
    scene.cameras[0].world[3] = {1, 2, 3, 1};
    finalise(scene);
    for (int turn = 0; turn < 2; ++turn) {
        place(scene, placement_of({.distance = 10, .direction = PlacedAlong::Y, .scale = 2}));
        EXPECT_EQ(glm::dvec3(scene.cameras[0].world[3]), glm::dvec3(2, 14, 6));
        EXPECT_EQ(glm::dvec3(scene.lights[0].world[3]), glm::dvec3(0, 10, 0));
    }
    place(scene, glm::dmat4(1));
    EXPECT_EQ(scene.cameras[0].world[3], glm::dvec4(1, 2, 3, 1));
}

TEST(Placement, ScalesLengthsOfCamerasAndLightsOfTheScene) {
    Scene scene;
    scene.cameras.push_back({.name = "perspective", .near = 1, .far = 100});
    scene.cameras.push_back({.name = "orthographic", .orthographic = true, .height = 4, .near = 2, .far = 50});
    scene.lights.push_back({.name = "lamp", .type = LightType::Point, .range = 3});
    finalise(scene);
    place(scene, placement_of({.scale = 200}));
    Settings settings;
    settings.camera.index = 0;
    const Camera perspective = make_camera(scene, settings, 1.5);
    EXPECT_NEAR(perspective.curve.near, 200, 1e-9);
    EXPECT_NEAR(perspective.curve.far, 20000, 1e-9);
    settings.camera.index = 1;
    const Camera orthographic = make_camera(scene, settings, 1.5);
    EXPECT_NEAR(orthographic.height, 800, 1e-9);
    EXPECT_NEAR(orthographic.curve.near, 400, 1e-9);
    EXPECT_NEAR(orthographic.curve.far, 10000, 1e-9);
    const CameraSettings by_hand = manual_camera(scene, settings, 1.5);
    EXPECT_NEAR(by_hand.height, 800, 1e-9);
    EXPECT_NEAR(by_hand.near, 400, 1e-9);
    EXPECT_NEAR(by_hand.far, 10000, 1e-9);

    const test::TemporaryFolder folder;
    save_gltf(scene, folder.path() / "scene.glb");
    const Scene written = load_gltf(folder.path() / "scene.glb");
    ASSERT_EQ(written.cameras.size(), 2u);
    EXPECT_NEAR(written.cameras[0].near, 200, 1e-9);
    EXPECT_NEAR(written.cameras[0].far, 20000, 1e-9);
    EXPECT_NEAR(written.cameras[1].height, 800, 1e-9);
    ASSERT_EQ(written.lights.size(), 1u);
    EXPECT_NEAR(written.lights[0].range, 600, 1e-9);
}

// The same picture from the new place: a manual camera sees each corner at the same pixel, at any distance and scale.
TEST(Placement, MovesSettings) {
    const std::vector<std::string> by_hand = {"camera.source=manual",     "camera.target_x=1", "camera.target_y=0.5",
                                              "camera.target_z=-2",       "camera.distance=9", "bias.unit=metres",
                                              "bias.constant=0.02",       "light.type=spot",   "light.size=0.5",
                                              "filter.radius_unit=texels"};
    const Session home = placed_session(by_hand);
    Scene scene = home.scene;
    const Camera before = make_camera(scene, home.settings, 1.5);
    for (const double scale : {1e-3, 1.0, 1e3})
        for (const double distance : {0.0, 777.0, 1e7}) {
            Settings s = home.settings;
            s.scene.scale = scale;
            s.scene.distance = distance;
            pose_scene(scene, s.scene);
            carry_settings(s, home.settings.scene, s.scene);
            EXPECT_NEAR(s.bias.constant, 0.02 * scale, 1e-12);
            EXPECT_NEAR(s.lights[0].size, std::min(0.5 * scale, 100.0), 1e-12);
            EXPECT_EQ(s.filter.radius, home.settings.filter.radius) << "in texels";
            const Camera camera = make_camera(scene, s, 1.5);
            for (const glm::dvec3& corner : home.scene.bounds.corners()) {
                const glm::dvec4 was = before.project(corner, 300, 200);
                const glm::dvec3 there(placement_of(s.scene) * glm::dvec4(corner, 1));
                const glm::dvec4 is = camera.project(there, 300, 200);
                // Doubles resolve 2e-9 m at 10^7 m.
                EXPECT_NEAR(is.x, was.x, 1e-6 + distance * 1e-12 / scale) << distance << " " << scale;
                EXPECT_NEAR(is.y, was.y, 1e-6 + distance * 1e-12 / scale);
            }
        }
}

// Metres of presets and scenes are scaled; values of --set are not.
TEST(Placement, ScalesLengthsOfPresetsButNotOfSetArguments) {
    const Session s = placed_session({"scene.scale=10", "light.contact=0.5"});
    EXPECT_EQ(s.settings.lights[0].contact, 0.5);
    EXPECT_EQ(s.settings.scene.scale, 10);
    EXPECT_NEAR(s.scene.bounds.radius(), 10 * placed_session({}).scene.bounds.radius(), 1e-9);
}

TEST(Placement, CommandLinesKeepLengthsOfAScaledScene) {
    Scene scene = placed_session({}).scene;
    Settings unscaled = base_settings(scene);
    ASSERT_GT(unscaled.filter.thickness, 0);
    unscaled.scene.scale = 10;
    pose_scene(scene, unscaled.scene);
    Settings scaled = unscaled;
    carry_settings(scaled, SceneSettings{}, scaled.scene);
    for (const Settings& settings : {unscaled, scaled}) {
        const SessionPlan plan = session_plan("boxes", scene, settings);
        EXPECT_EQ(compose_settings(plan, scene, settings.scene).settings, settings);
    }
}

}  // namespace
}  // namespace si
