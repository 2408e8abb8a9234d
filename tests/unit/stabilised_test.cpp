// Tests of spheres and depths of stabilised maps. tests/hard_cases/snapping_test.cpp tests their promises.
#include <gtest/gtest.h>

#include <random>

#include "renderer/base/directions.h"
#include "renderer/settings/splits.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/cascades/cascades.h"
#include "tests/support/box_scene.h"

namespace si {
namespace {

// The sphere holds every corner of the slice, touches some, and has the same size for every camera position.
TEST(Stabilised, SphereIsTheSmallest) {
    Settings s;
    s.camera.source = CameraSource::Manual;
    const Scene scene = test::blocks_on_ground({0, 0, 0}, 1);
    for (const double fov : {15., 60., 110.})
        for (const bool orthographic : {false, true})
            for (const auto& [near, far] : {std::pair{0.0, 9.0}, {1.0, 2.0}, {30.0, 31.0}}) {
                s.camera.fov = fov;
                s.camera.orthographic = orthographic;
                double radius = -1;
                for (const double azimuth : {0., 90., 33.}) {
                    s.camera.azimuth = azimuth;
                    s.camera.target_x = azimuth * 1e3;
                    const Camera camera = make_camera(scene, s, 16.0 / 9);
                    const Sphere sphere = bounding_sphere(camera, {near, far});
                    EXPECT_TRUE(radius < 0 || std::abs(sphere.radius - radius) <= 1e-9 * radius);
                    radius = sphere.radius;
                    const double half = orthographic ? 0.5 * camera.height : std::tan(0.5 * camera.fov_y_rad);
                    double farthest = 0, least_far = 1e300, towards = 0;
                    for (int i = 0; i < 8; ++i) {
                        const double z = i & 4 ? far : near, scale = orthographic ? 1 : z;
                        const glm::dvec3 corner =
                            camera.eye + camera.axes * glm::dvec3((i & 1 ? 1 : -1) * scale * half * camera.aspect,
                                                                  (i & 2 ? 1 : -1) * scale * half, -z);
                        const double d = glm::distance(corner, sphere.centre);
                        farthest = std::max(farthest, d);
                        if (i & 4) least_far = std::min(least_far, d);
                        if (i & 4) towards = glm::dot(sphere.centre - camera.eye, -camera.axes[2]) - far;
                    }
                    EXPECT_NEAR(farthest, radius, 1e-9 * radius);
                    EXPECT_NEAR(least_far, radius, 1e-9 * radius) << "the far corners lie on it";
                    EXPECT_LE(towards, 1e-9 * far) << "its middle not beyond them";
                }
            }
}

// Visible points are inside the depth range for every camera direction, and the range stays as the camera turns.
TEST(Stabilised, DepthsHoldTheScene) {
    const glm::dvec3 centre(5, -2, 100);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 500; ++i) {
        Camera camera;
        camera.orthographic = i % 4 == 0;
        camera.eye =
            centre + 40.0 * std::exp2(3 * unit(random)) * glm::normalize(glm::dvec3(unit(random), unit(random), 0.3));
        camera.axes = orthonormal_basis(glm::normalize(glm::dvec3(unit(random), unit(random), unit(random))));
        const DepthSpan span = rotation_stable_depths(camera, centre, 20);
        for (int k = 0; k < 50; ++k) {
            const glm::dvec3 way = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
            const double depth = glm::dot(camera.eye - (centre + 20.0 * way), camera.axes[2]);
            if (depth < 0 && !camera.orthographic) continue;
            EXPECT_LE(depth, span.to_m + 1e-9);
            const glm::dvec3 v = glm::transpose(camera.axes) * (centre + 20.0 * way - camera.eye);
            const bool seen = std::max(std::abs(v.x), std::abs(v.y)) <= std::tan(0.5 * camera.fov_y_rad) * depth;
            EXPECT_TRUE(!(camera.orthographic || seen) || depth >= span.from_m - 1e-9);
        }
        const DepthSpan turned = [&] {
            Camera other = camera;
            other.axes = orthonormal_basis(glm::normalize(glm::dvec3(unit(random), unit(random), unit(random))));
            return rotation_stable_depths(other, centre, 20);
        }();
        EXPECT_TRUE(camera.orthographic || turned == span);
        EXPECT_GT(span.to_m, span.from_m);
    }
}

}  // namespace
}  // namespace si
