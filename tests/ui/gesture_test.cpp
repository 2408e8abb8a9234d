// Tests of mouse gestures on camera and light, and of frustum lines, compared with projection by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "renderer/base/directions.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/box_scene.h"
#include "ui/scene_view/camera_gesture.h"
#include "ui/scene_view/frustum_lines.h"

namespace si {
namespace {

constexpr int kPictureWidth = 640, kPictureHeight = 400;

Settings manual(bool orthographic) {
    Settings s;
    s.camera.source = CameraSource::Manual;
    s.camera.orthographic = orthographic;
    s.camera.target_x = 3;
    s.camera.target_y = 1;
    s.camera.distance = 12;
    s.camera.height = 9;
    return s;
}

glm::dvec3 target(const CameraSettings& c) {
    return {c.target_x, c.target_y, c.target_z};
}

TEST(Gesture, PanKeepsTheFocusUnderTheCursor) {
    const Scene scene = test::box_scene({{}});
    for (const bool orthographic : {false, true}) {
        Settings s = manual(orthographic);
        const Camera before = make_camera(scene, s, double(kPictureWidth) / kPictureHeight);
        const glm::dvec3 point = target(s.camera);
        const glm::dvec4 p = before.project(point, kPictureWidth, kPictureHeight);
        pan_camera(s.camera, before, 37, -21, kPictureHeight);
        const glm::dvec4 q =
            make_camera(scene, s, double(kPictureWidth) / kPictureHeight).project(point, kPictureWidth, kPictureHeight);
        EXPECT_NEAR(q.x - p.x, 37, 1e-6);
        EXPECT_NEAR(q.y - p.y, -21, 1e-6);
    }
}

TEST(Gesture, OrbitTurnsAboutTheTargetAndStopsAtThePoles) {
    const Scene scene = test::box_scene({{}});
    Settings s = manual(false);
    const Camera before = make_camera(scene, s, 1.6);
    // A point in front of the target follows the mouse.
    const glm::dvec3 front = target(s.camera) + before.axes[2];
    const double x = before.project(front, kPictureWidth, kPictureHeight).x;
    orbit_camera(s.camera, 20, 0);
    const Camera after = make_camera(scene, s, 1.6);
    EXPECT_GT(after.project(front, kPictureWidth, kPictureHeight).x, x + 1);
    EXPECT_NEAR(glm::distance(after.eye, target(s.camera)), 12, 1e-9);
    orbit_camera(s.camera, 0, 1e6);
    EXPECT_EQ(s.camera.elevation, 90);
    orbit_camera(s.camera, 0, -1e7);
    EXPECT_EQ(s.camera.elevation, -90);
    EXPECT_GE(s.camera.azimuth, -180);
    EXPECT_LE(s.camera.azimuth, 180);
}

/// Returns the scene's picture as PictureView defines it.
PictureView view_of(const Scene& scene, const Settings& s) {
    return {make_camera(scene, s, double(kPictureWidth) / kPictureHeight), {0, 0}, {kPictureWidth, kPictureHeight}, 1};
}

TEST(Gesture, ZoomingKeepsThePointUnderTheCursorAndIsReversible) {
    const Scene scene = test::box_scene({{}});
    for (const bool orthographic : {false, true}) {
        Settings s = manual(orthographic);
        const glm::dvec2 cursor(500, 90);
        const PictureView before = view_of(scene, s);
        const glm::dvec3 under = *intersect_plane(before.ray(cursor), target(s.camera), before.camera.axes[2]);
        zoom_camera(s.camera, before.camera, before.ray(cursor), 3);
        EXPECT_LT(s.camera.distance, 12);
        EXPECT_LT(s.camera.height, 9);
        const PictureView after = view_of(scene, s);
        EXPECT_NEAR(after.point(under)->x, cursor.x, 1e-6);
        EXPECT_NEAR(after.point(under)->y, cursor.y, 1e-6);
        zoom_camera(s.camera, after.camera, after.ray(cursor), -3);
        EXPECT_NEAR(s.camera.distance, 12, 1e-9);
        EXPECT_NEAR(glm::distance(target(s.camera), target(manual(orthographic).camera)), 0, 1e-9);
    }
}

TEST(Gesture, LookingAroundKeepsTheEye) {
    const Scene scene = test::box_scene({{}});
    Settings s = manual(false);
    s.camera.elevation = 20;
    const Camera before = make_camera(scene, s, 1.6);
    turn_camera(s.camera, 30, 10);
    const Camera after = make_camera(scene, s, 1.6);
    EXPECT_NEAR(glm::distance(after.eye, before.eye), 0, 1e-9);
    EXPECT_GT(glm::dot(-after.axes[2], before.axes[0]), 0) << "mouse to the right looks to the right";
    EXPECT_LT(glm::dot(-after.axes[2], before.axes[1]), 0) << "mouse down looks down";
}

TEST(Gesture, FlyingMovesEyeAndTargetEqually) {
    const Scene scene = test::box_scene({{}});
    Settings s = manual(false);
    const Camera before = make_camera(scene, s, 1.6);
    move_camera(s.camera, {2, 0.5, 3});
    const Camera after = make_camera(scene, s, 1.6);
    const glm::dvec3 moved = after.eye - before.eye,
                     expected = 2.0 * before.axes[0] + glm::dvec3(0, 0.5, 0) - 3.0 * before.axes[2];
    EXPECT_NEAR(glm::distance(moved, expected), 0, 1e-9);
    EXPECT_EQ(after.axes, before.axes);
    // Objects grow under parallel rays only if the view gets smaller.
    Settings parallel = manual(true);
    move_camera(parallel.camera, {0, 0, 3});
    EXPECT_NEAR(parallel.camera.height, 9 * std::exp(-3.0 / 12), 1e-9);
}

TEST(Gesture, ViewAlongAnAxisShowsTheOtherTwoAxes) {
    const Scene scene = test::box_scene({{}});
    for (int axis = 0; axis < 3; ++axis)
        for (const bool positive : {false, true}) {
            Settings s = manual(false);
            s.camera.roll = 30;
            look_along_axis(s.camera, axis, positive);
            const Camera c = make_camera(scene, s, 1.6);
            glm::dvec3 from(0);
            from[axis] = positive ? 1 : -1;
            EXPECT_NEAR(glm::distance(c.axes[2], from), 0, 1e-9);
            if (axis != 1) {
                EXPECT_NEAR(c.axes[1].y, 1, 1e-9) << "y is up";
            }
        }
}

TEST(Gesture, FramingFillsThePictureWithTheBounds) {
    const Scene scene = test::box_scene({{{-4, 0, -1}, {9, 3, 5}}}, {1e4, 0, -300});
    for (const bool orthographic : {false, true})
        for (const double aspect : {0.5, 1.6}) {
            Settings s = manual(orthographic);
            s.camera.near = 1;
            s.camera.far = 2;  // set for another view
            fill_picture_with(s.camera, scene.bounds, aspect);
            const int w = int(aspect * kPictureHeight);
            const Camera c = make_camera(scene, s, aspect);
            double reach = 0;
            for (int i = 0; i < 8; ++i) {
                const Bounds& b = scene.bounds;
                const glm::dvec3 corner(i & 1 ? b.hi.x : b.lo.x, i & 2 ? b.hi.y : b.lo.y, i & 4 ? b.hi.z : b.lo.z);
                const glm::dvec4 p = c.project(corner, w, kPictureHeight);
                EXPECT_GT(p.w, 0);
                reach = std::max(
                    {reach, std::abs((p.x + 0.5) / w * 2 - 1), std::abs((p.y + 0.5) / kPictureHeight * 2 - 1)});
            }
            EXPECT_LE(reach, 1.0) << "orthographic " << orthographic << " aspect " << aspect;
            EXPECT_GT(reach, 0.4);
            EXPECT_EQ(s.camera.near, 0);
            EXPECT_EQ(s.camera.far, 0);
        }
}

TEST(Gesture, LightFollowsTheMouseOnBothSides) {
    const Scene scene = test::box_scene({{}});
    const Settings s = manual(false);
    const Camera c = make_camera(scene, s, 1.6);
    for (const double azimuth : {s.camera.azimuth + 40, s.camera.azimuth + 170}) {
        LightSettings light;
        light.azimuth = azimuth;
        light.elevation = 30;
        const auto x_of = [&] { return glm::dot(direction_from_angles(light.azimuth, light.elevation), c.axes[0]); };
        const double before = x_of();
        turn_light(light, c, 10, -10);
        EXPECT_GT(x_of(), before);
        EXPECT_GT(light.elevation, 30);
    }
}

TEST(LightLines, EdgesEndAtTheCornersOfClipSpace) {
    const Scene scene = test::box_scene({{}});
    for (const LightType type : {LightType::Directional, LightType::Spot, LightType::Point}) {
        Settings s;
        s.lights[0].type = type;
        for (const FittedLight& light : fit_lights(scene, s))
            for (const LightView& view : light.views) {
                const auto edges = frustum_edges(view);
                ASSERT_EQ(edges.size(), 12u);
                for (const Segment& e : edges)
                    for (const glm::dvec3& p : {e.from, e.to}) {
                        const glm::dvec4 clip = view.clip_from_relative(p) * glm::dvec4(0, 0, 0, 1);
                        EXPECT_NEAR(std::abs(clip.x / clip.w), 1, 1e-6);
                        EXPECT_NEAR(std::abs(clip.y / clip.w), 1, 1e-6);
                    }
            }
    }
}

TEST(LightLines, SegmentThroughTheCameraKeepsThePartInFront) {
    const Scene scene = test::box_scene({{}});
    const Camera c = make_camera(scene, manual(false), 1.6);
    const glm::dvec3 front = c.eye - 5.0 * c.axes[2] + c.axes[0], behind = c.eye + 5.0 * c.axes[2] + c.axes[0];
    const auto on = project_segment(c, front, behind, kPictureWidth, kPictureHeight);
    ASSERT_TRUE(on);
    EXPECT_NEAR(on->first.x, c.project(front, kPictureWidth, kPictureHeight).x, 1e-9);
    EXPECT_GT(on->second.x, on->first.x) << "both points lie to the right, the nearer one further out";
    const auto reversed = project_segment(c, behind, front, kPictureWidth, kPictureHeight);
    ASSERT_TRUE(reversed);
    EXPECT_NEAR(reversed->first.x, on->second.x, 1e-3);
    EXPECT_NEAR(reversed->second.x, on->first.x, 1e-9);
    EXPECT_FALSE(project_segment(c, behind, behind + c.axes[1], kPictureWidth, kPictureHeight));
}

}  // namespace
}  // namespace si
