// Tests of hierarchy, instances, cameras and lights of glTF files.
#include <gtest/gtest.h>

#include <numbers>

#include "renderer/settings/settings.h"
#include "tests/unit/gltf_test_file.h"

namespace si::test {
namespace {

void expect_place_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-9) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

glm::dvec3 moved_by(const glm::dmat4& m, const glm::dvec3& p) {
    return glm::dvec3(m * glm::dvec4(p, 1));
}

TEST(GltfScene, TransformsScaleThenRotateThenTranslate) {
    GltfFile file;
    file.add_triangle();
    const double h = std::sqrt(0.5);
    // A quarter turn about z, stored last-w-first in glTF as x y z w.
    file.json["nodes"][0]["translation"] = {10, 20, 30};
    file.json["nodes"][0]["rotation"] = {0, 0, h, h};
    file.json["nodes"][0]["scale"] = {2, -3, 4};
    const Scene scene = file.load();
    expect_place_near(moved_by(scene.objects[0].world, {1, 0, 0}), {10, 22, 30});
    expect_place_near(moved_by(scene.objects[0].world, {0, 1, 0}), {13, 20, 30});
    EXPECT_LT(glm::determinant(scene.objects[0].world), 0);
}

TEST(GltfScene, ParentsComeFirstAndMultiplyFromTheLeft) {
    GltfFile file;
    const int mesh = file.mesh({{"attributes", {{"POSITION", file.triangle_positions()}}}});
    // The file lists the child before its parent.
    file.append("nodes",
                {{"mesh", mesh}, {"name", "child"}, {"matrix", {1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1}}});
    file.root({{"children", {0}}, {"name", "parent"}, {"scale", {2, 1, 1}}});
    const Scene scene = file.load();
    ASSERT_EQ(scene.nodes.size(), 2u);
    EXPECT_EQ(scene.nodes[0].name, "parent");
    EXPECT_EQ(scene.nodes[1].parent, 0);
    EXPECT_EQ(scene.nodes[1].path, "parent/child");
    expect_place_near(moved_by(scene.objects[0].world, {0, 1, 0}), {7, 1, 0});  // sheared by 0.5, moved by 3, doubled
}

TEST(GltfScene, OtherScenesAreLeftOut) {
    GltfFile file;
    const int mesh = file.mesh({{"attributes", {{"POSITION", file.triangle_positions()}}}});
    file.append("nodes", {{"mesh", mesh}, {"name", "first"}});
    file.append("nodes", {{"mesh", mesh}, {"name", "second"}});
    file.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    file.json["scene"] = 1;
    EXPECT_EQ(file.load().nodes.at(0).name, "second");
    GltfOptions options;
    options.file.scene = 0;
    EXPECT_EQ(file.load(options).nodes.at(0).name, "first");
    options.file.scene = 2;
    EXPECT_THROW(file.load(options), Error);
    file.json.erase("scenes");
    file.json.erase("scene");
    EXPECT_EQ(file.load().nodes.size(), 2u);
}

TEST(GltfScene, InstancesShareTheMesh) {
    GltfFile file;
    file.add_triangle();
    const double h = std::sqrt(0.5);
    const int translation = file.floats({0, 0, 0, 5, 0, 0}, "VEC3"), scale = file.floats({1, 1, 1, 2, 2, 2}, "VEC3");
    const float f = static_cast<float>(h);
    const int rotation = file.floats({0, 0, 0, 1, 0, 0, f, f}, "VEC4");
    file.json["nodes"][0]["translation"] = {0, 0, 100};
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", translation}, {"SCALE", scale}, {"ROTATION", rotation}};
    file.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const Scene scene = file.load();
    EXPECT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.objects.size(), 2u);
    expect_place_near(moved_by(scene.objects[0].world, {1, 0, 0}), {1, 0, 100});
    expect_place_near(moved_by(scene.objects[1].world, {1, 0, 0}), {5, 2, 100}, 1e-6);
}

TEST(GltfScene, ReadsCamerasOfBothTypes) {
    GltfFile file;
    file.add_triangle();
    file.json["cameras"] = {
        {{"type", "perspective"}, {"name", "eye"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.5}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 9}}}}};
    file.root({{"camera", 0}, {"translation", {1, 2, 3}}});
    file.root({{"camera", 1}, {"name", "plan"}});
    const Scene scene = file.load();
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].name, "eye");
    EXPECT_NEAR(scene.cameras[0].fov_y_deg, 180 / std::numbers::pi, 1e-9);
    EXPECT_EQ(scene.cameras[0].near, 0.5);
    EXPECT_EQ(scene.cameras[0].far, 0);
    expect_place_near(glm::dvec3(scene.cameras[0].world[3]), {1, 2, 3});
    EXPECT_EQ(scene.cameras[1].name, "plan");
    EXPECT_TRUE(scene.cameras[1].orthographic);
    EXPECT_EQ(scene.cameras[1].height, 4);
    EXPECT_EQ(scene.cameras[1].far, 9);
}

TEST(GltfScene, ReadsLightsOfThreeTypes) {
    GltfFile file;
    file.add_triangle();
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 3}, {"color", {1, 0.5, 0.25}}},
        {{"type", "point"}, {"range", 12}},
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.6}}}},
        {{"type", "spot"}}};
    const Json rotation = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
    for (int i = 0; i < 4; ++i) {
        file.root({{"rotation", rotation}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    }
    const Scene scene = file.load();
    ASSERT_EQ(scene.lights.size(), 4u);
    EXPECT_EQ(scene.lights[0].type, LightType::Directional);
    EXPECT_EQ(scene.lights[0].intensity, 3);
    EXPECT_EQ(scene.lights[0].colour, glm::dvec3(1, 0.5, 0.25));
    expect_place_near(-glm::dvec3(scene.lights[0].world[2]), {0, 1, 0});  // -z turned by +90 degrees about x
    EXPECT_EQ(scene.lights[1].type, LightType::Point);
    EXPECT_EQ(scene.lights[1].range, 12);
    EXPECT_EQ(scene.lights[2].range, 0) << "unlimited";
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    EXPECT_EQ(scene.lights[2].type, LightType::Spot);
    EXPECT_EQ(scene.lights[2].inner_cone_rad, 0.2);
    EXPECT_EQ(scene.lights[2].outer_cone_rad, 0.6);
    EXPECT_NEAR(scene.lights[3].outer_cone_rad, std::numbers::pi / 4, 1e-12);
}

/// Makes a file with a triangle in node 1, a child of node 0 that moves it by 4. @param listed nodes of the scene
GltfFile with_child(const Json& listed) {
    GltfFile file;
    file.append("nodes", {{"children", {1}}, {"translation", {4, 0, 0}}});
    file.add_triangle();
    file.json["scenes"][0]["nodes"] = listed;
    return file;
}

TEST(GltfScene, AListedChildIsDrawnAsARootWithANote) {
    const Scene scene = with_child({1}).load();
    ASSERT_EQ(scene.objects.size(), 1u);
    expect_place_near(scene.bounds.lo, {0, 0, 0});
    EXPECT_TRUE(mentions(scene.warnings,
                         "scenes[0].nodes: node 1 is no root, it is a child of node 0; drawn as a root, without its "
                         "parent's transform"));
}

TEST(GltfScene, AListedChildOfAListedNodeIsDrawnOnceBelowIt) {
    for (const Json& listed : {Json{0, 1}, Json{1, 0}}) {
        const Scene scene = with_child(listed).load();
        ASSERT_EQ(scene.objects.size(), 1u);
        expect_place_near(scene.bounds.lo, {4, 0, 0});
        EXPECT_TRUE(mentions(scene.warnings, "node 1 is no root, it is a child of node 0; drawn below it"));
    }
    EXPECT_TRUE(with_child({0}).load().warnings.empty());
}

TEST(GltfScene, CyclesSecondParentsAndDanglingChildrenAreRefused) {
    const auto with_children = [](std::initializer_list<Json> children) {
        GltfFile file;
        file.add_triangle();
        for (const Json& list : children) file.append("nodes", {{"children", list}});
        return file.error();
    };
    EXPECT_EQ(with_children({{2}, Json::array()}), "");
    EXPECT_NE(with_children({{2}, {1}}).find("or is its own"), std::string::npos);
    EXPECT_NE(with_children({{3}, {3}, Json::array()}).find("nodes[2].children: node 3 is already a child of node 1"),
              std::string::npos);
    EXPECT_NE(with_children({{9}}).find("nodes[1].children[0]: index 9 is out of range"), std::string::npos);
}

}  // namespace
}  // namespace si::test
