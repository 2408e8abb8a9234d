// Tests of cameras: orbit, rays of pixels, automatic framing.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <random>

#include "renderer/base/angles.h"
#include "renderer/base/directions.h"
#include "renderer/base/index_of.h"
#include "renderer/scene/extreme_points.h"
#include "renderer/scene/ground.h"
#include "renderer/scenes/shapes.h"
#include "renderer/view/cameras/make_camera.h"
#include "tests/support/box_scene.h"
#include "tests/support/sets.h"

namespace si {
namespace {

void expect_orthonormal(const glm::dmat3& m) {
    const glm::dmat3 product = glm::transpose(m) * m;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(product[i][j], i == j, 1e-14);
    EXPECT_NEAR(glm::determinant(m), 1.0, 1e-14);
}

TEST(Camera, OrbitPositionFollowsTheAngles) {
    Settings s =
        settings_with({}, {"camera.source=manual", "camera.target_x=1", "camera.target_y=2", "camera.target_z=3",
                           "camera.distance=5", "camera.azimuth=90", "camera.elevation=0"});
    const Camera c = make_camera(test::box_scene({}), s, 1.5);
    EXPECT_NEAR(glm::distance(c.eye, glm::dvec3(6, 2, 3)), 0, 1e-12);
    EXPECT_NEAR(glm::distance(c.axes[0], glm::dvec3(0, 0, -1)), 0, 1e-12);  // right
    EXPECT_NEAR(glm::distance(c.axes[1], glm::dvec3(0, 1, 0)), 0, 1e-12);
    EXPECT_EQ(c.focus, 5);
    const glm::dvec4 at = c.project({1, 2, 3}, 300, 200);
    EXPECT_NEAR(at.x, 149.5, 1e-9);
    EXPECT_NEAR(at.y, 99.5, 1e-9);
    // A point 1 m above the target appears above it, a point 1 m to the right (towards -z) to its right.
    EXPECT_LT(c.project({1, 3, 3}, 300, 200).y, at.y);
    EXPECT_GT(c.project({1, 2, 2}, 300, 200).x, at.x);
}

TEST(Camera, StraightUpAndDownAreOrdinaryViews) {
    Settings s;
    s.camera.source = CameraSource::Manual;
    for (double elevation : {90.0, -90.0, 89.9999999, 0.0})
        for (double azimuth : {0.0, 35.0, -170.0, 720.0}) {
            s.camera.elevation = elevation;
            s.camera.azimuth = azimuth;
            s.camera.roll = 30;
            const Camera c = make_camera(test::box_scene({}), s, 1);
            expect_orthonormal(c.axes);
            const Camera near_by = [&] {
                Settings t = s;
                t.camera.elevation += elevation > 0 ? -1e-6 : 1e-6;
                return make_camera(test::box_scene({}), t, 1);
            }();
            for (int i = 0; i < 3; ++i) EXPECT_NEAR(glm::distance(c.axes[i], near_by.axes[i]), 0, 1e-7);
        }
}

TEST(Camera, PixelRayAndProjectAreInverse) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    for (bool orthographic : {false, true}) {
        Settings s;
        s.camera.source = CameraSource::Manual;
        s.camera.orthographic = orthographic;
        s.camera.roll = 17;
        s.camera.target_x = 1e6;
        const Camera c = make_camera(test::box_scene({}), s, 1.6);
        for (int i = 0; i < 200; ++i) {
            const double x = unit(random) * 640, y = unit(random) * 400;
            glm::dvec3 origin, dir;
            c.pixel_ray(x, y, 640, 400, origin, dir);
            EXPECT_NEAR(glm::length(dir), 1, 1e-14);
            const glm::dvec4 p = c.project(origin + dir * 7.5, 640, 400);
            EXPECT_NEAR(p.x, x, 1e-6);
            EXPECT_NEAR(p.y, y, 1e-6);
            EXPECT_GT(p.w, 0);
        }
    }
    // The first pixel is the top left one.
    const Camera c = make_camera(test::box_scene({}), Settings(), 1);
    glm::dvec3 origin, dir;
    c.pixel_ray(0, 0, 100, 100, origin, dir);
    EXPECT_LT(glm::dot(dir, c.axes[0]), 0);
    EXPECT_GT(glm::dot(dir, c.axes[1]), 0);
}

TEST(Camera, AutomaticViewFramesTheBounds) {
    for (double aspect : {0.4, 1.0, 1.78, 4.0})
        for (double scale : {1e-6, 1.0, 1e7}) {
            Settings s;
            s.camera.orthographic = true;  // has an effect with a manual camera only
            const Scene scene = test::box_scene({{glm::dvec3(-3, 0, -2) * scale, glm::dvec3(4, 1.5, 2) * scale}},
                                                glm::dvec3(7, -2, 1) * scale);
            const Camera c = make_camera(scene, s, aspect);
            EXPECT_FALSE(c.orthographic);
            double widest = 0;
            for (int i = 0; i < 8; ++i) {
                const glm::dvec3 p(i & 1 ? scene.bounds.hi.x : scene.bounds.lo.x,
                                   i & 2 ? scene.bounds.hi.y : scene.bounds.lo.y,
                                   i & 4 ? scene.bounds.hi.z : scene.bounds.lo.z);
                const glm::dvec4 q = c.clip_from_relative(c.origin()) * glm::dvec4(p - c.origin(), 1);
                EXPECT_LE(std::abs(q.x / q.w), 1);
                EXPECT_LE(std::abs(q.y / q.w), 1);
                EXPECT_GE(q.z / q.w, 0);
                EXPECT_LE(q.z / q.w, 1);
                widest = std::max({widest, std::abs(q.x / q.w), std::abs(q.y / q.w)});
            }
            EXPECT_GT(widest, 0.8) << "the bounds should nearly fill the picture";
        }
}

/// Makes a box of 1 x 2 x 1 m on a floor of 40 x 40 m, as if from a file.
Scene box_on_wide_floor() {
    Scene scene = test::box_scene({{{-0.5, 0, -0.5}, {0.5, 2, 0.5}}, {{-20, -0.01, -20}, {20, 0, 20}}});
    scene.file_scenes = {""};
    refresh(scene);
    return scene;
}

/// Returns the distance of a point from the picture's centre, 1 at the border.
double distance_from_centre(const Camera& c, const glm::dvec3& p) {
    const glm::dvec4 q = c.clip_from_relative(c.eye) * glm::dvec4(p - c.eye, 1);
    return q.w > 0 ? std::max(std::abs(q.x / q.w), std::abs(q.y / q.w)) : INFINITY;
}

TEST(Camera, AutomaticViewFramesObjectsOnAFloorWithTheirShadow) {
    const Scene scene = box_on_wide_floor();
    const Settings s;
    const glm::dvec3 to_light = direction_from_angles(s.lights[0].azimuth, s.lights[0].elevation);
    for (const double aspect : {0.5, 1.0, 1.78, 3.0}) {
        SCOPED_TRACE(aspect);
        const Camera c = make_camera(scene, s, aspect);
        double farthest = 0;
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 corner(i & 1 ? 0.5 : -0.5, i & 2 ? 2 : 0, i & 4 ? 0.5 : -0.5);
            for (const glm::dvec3& p : {corner, corner - to_light * (corner.y / to_light.y)})
                farthest = std::max(farthest, distance_from_centre(c, p));
        }
        EXPECT_NEAR(farthest, 0.85, 0.01);
        EXPECT_GT(distance_from_centre(c, {20, 0, 20}), 1) << "the floor goes on beyond the picture";
        Settings bare = s;
        bare.scene.ground = Ground::Off;
        EXPECT_LE(distance_from_centre(make_camera(scene, bare, aspect), {20, 0, 20}), 1) << "all of the scene";
    }
    Scene built_in = scene;
    built_in.file_scenes.clear();
    EXPECT_LE(distance_from_centre(make_camera(built_in, s, 1), {20, 0, 20}), 1)
        << "what no file brings is shown whole";
}

constexpr double kUsual_deg = 16;  ///< the automatic camera's elevation over an upright model

TEST(Camera, AutomaticViewLooksDownOnFlatAndAcrossLongScenes) {
    const auto back = [](const glm::dvec3& size) {
        Scene scene = test::box_scene({{glm::dvec3(0), size}});
        scene.file_scenes = {""};
        refresh(scene);
        add_ground(scene);
        return make_camera(scene, Settings(), 1.5).axes[2];
    };
    const CameraSettings standard;
    const glm::dvec3 cube = back({1, 1, 1}), flat = back({10, 0.1, 10}), along_x = back({50, 1, 1}),
                     along_z = back({1, 1, 50});
    EXPECT_NEAR(cube.y, std::sin(kUsual_deg * std::numbers::pi / 180), 1e-9);
    EXPECT_LT(kUsual_deg, standard.fov / 2 - 5) << "the horizon is well below the picture's top";
    EXPECT_NEAR(std::atan2(cube.x, cube.z), standard.azimuth * std::numbers::pi / 180, 1e-9);
    EXPECT_GT(flat.y, std::sin(45 * std::numbers::pi / 180));
    EXPECT_LT(std::abs(along_x.x), 0.3 * along_x.z) << "from beside it";
    EXPECT_LT(std::abs(along_z.z), 0.5 * along_z.x);
}

TEST(Camera, AutomaticViewShowsTheShadowOverItsCaster) {
    Scene scene;
    const int mesh = add_mesh(scene, "sail", make_polygons("sail", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}), -1);
    add_object(scene, "sail", -1, mesh, glm::dmat4(1));
    scene.file_scenes = {""};
    finalise(scene);
    add_ground(scene);
    store_framing_points(scene);
    const double usual = kUsual_deg * std::numbers::pi / 180;
    const Camera over = make_camera(scene, Settings(), 1.5);
    EXPECT_GT(over.axes[2].y, std::sin(usual) + 0.05);
    for (const double aspect : {0.3, 1.0, 5.0})
        EXPECT_EQ(make_camera(scene, Settings(), aspect).axes, over.axes) << "from one side in windows of any shape";
    // Turned round, its shadow falls on the visible side.
    place(scene, glm::rotate(glm::dmat4(1), 1.5, glm::dvec3(0, 1, 0)));
    EXPECT_NEAR(make_camera(scene, Settings(), 1.5).axes[2].y, std::sin(usual), 1e-9);
}

TEST(Camera, OriginStaysForSmallMoves) {
    Settings s;
    s.camera.source = CameraSource::Manual;
    s.camera.target_x = 1e6 - 27;
    s.camera.distance = 10;
    const Scene scene = test::box_scene({});
    const glm::dvec3 origin = make_camera(scene, s, 1).origin();
    s.camera.azimuth += 20;
    s.camera.target_y += 0.5;
    EXPECT_EQ(make_camera(scene, s, 1).origin(), origin);
    constexpr double kGrid = 64;  // 2^ceil(log2(4 * 10))
    EXPECT_LE(glm::distance(origin, make_camera(scene, s, 1).eye), kGrid * std::sqrt(3.0) / 2);
    EXPECT_EQ(std::fmod(origin.x, kGrid), 0);
    EXPECT_NE(std::fmod(origin.x, 2 * kGrid), 0) << "1e6 - 27 is nearest to an odd multiple";
}

void expect_same_picture(const Camera& a, const Camera& b) {
    const glm::dmat4 p = a.clip_from_relative(a.eye), q = b.clip_from_relative(a.eye);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            double scale = 0;
            for (int k = 0; k < 4; ++k) scale = std::max(scale, std::abs(p[k][j]));
            EXPECT_NEAR(p[i][j], q[i][j], 1e-9 * scale) << i << j;
        }
}

TEST(Camera, ManualCameraIsTheSameView) {
    const double aspect = 1.3;
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 200; ++i) {
        Scene scene = test::box_scene({{glm::dvec3(-1), glm::dvec3(1)}});
        Settings s;
        s.camera.orthographic = i % 3 == 0;
        if (i > 0) {
            SceneCamera sc;
            sc.orthographic = i % 2;
            sc.fov_y_deg = 20 + i / 4.0;
            if (i % 5 == 0) {
                sc.near = 0.5;
                sc.far = 77;
            }
            glm::dvec3 back = i == 1   ? glm::dvec3(0, 1, 0)
                              : i == 2 ? glm::dvec3(0, -1, 0)
                                       : glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
            const glm::dmat3 axes = orthonormal_basis(back);
            const double scale = i % 7 == 0 ? 3 : 1;  // nodes may scale their cameras
            sc.world = glm::dmat4(glm::dmat3(axes[0] * scale, axes[1] * scale, axes[2] * scale));
            sc.world[3] = glm::dvec4(normal(random) * 10, normal(random) * 10, normal(random) * 10, 1);
            scene.cameras.push_back(sc);
        }
        const Camera automatic = make_camera(scene, s, aspect);
        Settings manual = s;
        manual.camera = manual_camera(scene, s, aspect);
        EXPECT_EQ(manual.camera.source, CameraSource::Manual);
        expect_same_picture(automatic, make_camera(scene, manual, aspect));
        EXPECT_EQ(manual_camera(scene, manual, aspect), manual.camera);
    }
}

TEST(Camera, StaysFiniteForAnyInput) {
    const double nan = std::nan(""), inf = INFINITY;
    std::vector<Scene> scenes = {Scene(), test::box_scene({{glm::dvec3(2), glm::dvec3(2)}}),
                                 test::box_scene({{glm::dvec3(0), glm::dvec3(1e-6)}}),
                                 test::box_scene({{glm::dvec3(0), glm::dvec3(1e7)}}, glm::dvec3(1e6))};
    scenes.push_back(scenes[1]);
    scenes.back().cameras.push_back({});
    scenes.back().cameras[0].world = glm::dmat4(0.0);
    for (const Scene& scene : scenes)
        for (double bad : {nan, inf, -1.0, 0.0, 1e300}) {
            Settings s;
            for (const CameraSource source : {CameraSource::Automatic, CameraSource::Manual})
                for (bool orthographic : {false, true}) {
                    s.camera = {};
                    s.camera.source = source;
                    s.camera.orthographic = orthographic;
                    s.camera.fov = s.camera.distance = s.camera.near = s.camera.far = s.camera.height = bad;
                    if (!std::isfinite(bad)) s.camera.azimuth = s.camera.elevation = s.camera.target_x = bad;
                    if (bad == 1e300) {
                        s.camera = {};
                        s.camera.near = 10;
                        s.camera.far = 1;
                    }
                    const Camera c = make_camera(scene, s, bad == 1e300 ? 1 : bad);
                    const glm::dmat4 m = c.clip_from_relative(c.origin());
                    for (int i = 0; i < 4; ++i)
                        for (int j = 0; j < 4; ++j)
                            ASSERT_TRUE(std::isfinite(m[i][j])) << bad << " " << index_of(source);
                    ASSERT_LT(c.curve.near, c.curve.far);
                    ASSERT_TRUE(c.orthographic || c.curve.near > 0);
                    expect_orthonormal(c.axes);
                }
        }
}

}  // namespace
}  // namespace si
