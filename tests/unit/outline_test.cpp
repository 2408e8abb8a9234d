// Tests of the outermost points of a scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "renderer/base/directions.h"
#include "renderer/scene/extreme_points.h"
#include "renderer/scenes/shapes.h"
#include "renderer/view/cameras/make_camera.h"
#include "tests/support/box_scene.h"

namespace si {
namespace {

double farthest(const std::vector<glm::dvec3>& points, const glm::dvec3& along) {
    double far = -INFINITY;
    for (const glm::dvec3& p : points) far = std::max(far, glm::dot(p, along));
    return far;
}

/// Returns all vertices of a scene's triangles in world space, except those of the named objects.
std::vector<glm::dvec3> vertices(const Scene& scene, std::string_view named = {}) {
    std::vector<glm::dvec3> out;
    for (const Object& o : scene.objects) {
        if (o.ground || !scene.nodes[std::size_t(o.node)].name.starts_with(named)) continue;
        const Mesh& mesh = scene.meshes[std::size_t(o.mesh)];
        for (const std::uint32_t i : mesh.indices)
            out.emplace_back(o.world * glm::dvec4(glm::dvec3(mesh.positions[i]), 1));
    }
    return out;
}

/// Makes sixty small spheres and a few large bodies, wide and low.
Scene bodies() {
    Scene scene;
    const int grey = add_material(scene, "grey", {1, 1, 1});
    const int sphere = add_mesh(scene, "sphere", make_sphere(0.4, 24, 12), grey);
    for (int i = 0; i < 60; ++i)
        add_object(scene, "sphere", -1, sphere, moved(6.0 * (i % 12), 0.1 * (i % 7), 12.0 * (i / 12)));
    add_object(scene, "torus", -1, add_mesh(scene, "torus", make_torus(6, 1), grey),
               moved(45, 3, 10) * turned(50, {1, 2, 0}) * scaled(1, 2, 1));
    add_object(scene, "box", -1, add_mesh(scene, "box", make_box({1, 9, 1}), grey), moved(-3, 2, 60) * turned(30));
    finalise(scene);
    return scene;
}

TEST(Outline, ApproximatesTheHullInEveryDirection) {
    const Scene scene = bodies();
    const std::vector<glm::dvec3> found = extreme_points(scene), all = vertices(scene);
    EXPECT_LE(found.size(), 64u);
    for (const glm::dvec3& p : found)
        EXPECT_TRUE(std::ranges::any_of(all, [&](const glm::dvec3& v) { return glm::distance(v, p) < 1e-9; }));
    for (int axis = 0; axis < 3; ++axis)
        for (const double way : {-1.0, 1.0}) {
            glm::dvec3 along(0);
            along[axis] = way;
            EXPECT_NEAR(farthest(found, along), farthest(all, along), 1e-9) << axis << " " << way;
        }
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 along = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        const double extent = farthest(all, along) + farthest(all, -along);
        EXPECT_LE(farthest(all, along) - farthest(found, along), 0.05 * extent + 1e-9) << i;
    }
}

TEST(Outline, UsesOnlyReferencedVerticesBeforePlacement) {
    Scene scene = bodies();
    const std::vector<glm::dvec3> before = extreme_points(scene);
    place(scene, moved(1000, -5, 3) * turned(70) * scaled(2, 2, 2));
    const std::vector<glm::dvec3> after = extreme_points(scene);
    for (const glm::dvec3& p : before)
        EXPECT_NEAR(farthest(after, glm::normalize(p)), farthest(before, glm::normalize(p)), 0.5);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 along(0);
        along[axis] = 1;
        EXPECT_NEAR(farthest(after, along), farthest(before, along), 1e-6);
    }

    Scene stray;
    Mesh mesh = make_box({1, 1, 1});
    mesh.positions.edit().push_back({100, 100, 100});
    mesh.normals.edit().push_back({0, 1, 0});
    mesh.uv.edit().push_back({0, 0});
    add_object(stray, "box", -1, add_mesh(stray, "box", std::move(mesh), -1), glm::dmat4(1));
    finalise(stray);
    EXPECT_NEAR(farthest(extreme_points(stray), {1, 0, 0}), 0.5, 1e-9);
    EXPECT_TRUE(extreme_points(Scene()).empty());
}

TEST(Outline, LeavesOutTheFloorButNotHiddenObjects) {
    Scene scene = test::box_scene({{{-0.5, 0, -0.5}, {0.5, 2, 0.5}}, {{-20, -0.01, -20}, {20, 0, 20}}});
    EXPECT_NEAR(farthest(extreme_points(scene), {1, 0, 0}), 0.5, 1e-9);
    hide_objects(scene, {scene.nodes[std::size_t(scene.objects[0].node)].path});
    EXPECT_NEAR(farthest(extreme_points(scene), {1, 0, 0}), 0.5, 1e-9);
    const Scene floor = test::box_scene({{{-20, -0.01, -20}, {20, 0, 20}}});
    EXPECT_NEAR(farthest(extreme_points(floor), {1, 0, 0}), 20, 1e-9) << "where there is nothing else";
    scene.meshes[std::size_t(all_objects(scene)[0]->mesh)].bounds = {};  // a pose that leaves no triangles
    refresh(scene);
    EXPECT_EQ(scene.bounds_without_floor.hi.x, 20);
}

// A sphere's box is one and a half times as wide as the sphere.
TEST(Outline, FillsThePictureOfAFile) {
    Scene scene;
    add_object(scene, "sphere", -1, add_mesh(scene, "sphere", make_sphere(1), add_material(scene, "grey", {1, 1, 1})),
               moved(5, 1, 5));
    add_object(scene, "floor", -1, add_mesh(scene, "floor", make_plane(60, 60), 0), glm::dmat4(1));
    scene.file_scenes = {""};
    finalise(scene);
    store_framing_points(scene);
    Settings s;
    const glm::dvec3 to_light = direction_from_angles(s.lights[0].azimuth, s.lights[0].elevation);
    for (const double aspect : {0.6, 1.0, 1.78}) {
        const Camera c = make_camera(scene, s, aspect);
        double out_of_middle = 0;
        for (const glm::dvec3& p : vertices(scene, "sphere"))
            for (const glm::dvec3& q : {p, p - to_light * (p.y / to_light.y)}) {
                const glm::dvec4 at = c.clip_from_relative(c.eye) * glm::dvec4(q - c.eye, 1);
                out_of_middle = std::max({out_of_middle, std::abs(at.x / at.w), std::abs(at.y / at.w)});
            }
        EXPECT_NEAR(out_of_middle, 0.86, 0.02) << aspect;
    }
}

}  // namespace
}  // namespace si
