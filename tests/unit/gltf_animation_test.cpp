// Tests of posed glTF scenes: keyframes, morph targets and skins.
#include <gtest/gtest.h>

#include "renderer/scene/animation.h"
#include "tests/unit/gltf_test_file.h"

namespace si::test {
namespace {

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-6) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

glm::dvec3 moved(const glm::dmat4& m, const glm::dvec3& p) {
    return glm::dvec3(m * glm::dvec4(p, 1));
}

/// Returns the position of vertex `i` of the scene's first object.
glm::dvec3 vertex(const Scene& scene, std::size_t i) {
    const Object& o = scene.objects.at(0);
    return moved(o.world, glm::dvec3(scene.meshes[static_cast<std::size_t>(o.mesh)].positions.all().at(i)));
}

AnimationChannel channel(Interpolation interpolation, std::vector<float> values, std::size_t width = 1) {
    AnimationChannel c;
    c.property = width == 4 ? AnimatedProperty::Rotation : AnimatedProperty::Weights;
    c.interpolation = interpolation;
    c.width = width;
    c.times_s = {1, 3};
    c.values = std::move(values);
    return c;
}

TEST(Animation, StepHoldsLinearBlends) {
    const AnimationChannel step = channel(Interpolation::Step, {10, 20}),
                           linear = channel(Interpolation::Linear, {10, 20});
    EXPECT_EQ(sample_channel(step, 2.9)[0], 10);
    EXPECT_EQ(sample_channel(step, 3.0)[0], 20);
    EXPECT_EQ(sample_channel(linear, 1.5)[0], 12.5);
    for (const auto& c : {step, linear}) {
        EXPECT_EQ(sample_channel(c, -5)[0], 10);
        EXPECT_EQ(sample_channel(c, 99)[0], 20);
        EXPECT_EQ(sample_channel(c, std::numeric_limits<double>::quiet_NaN())[0], 10);
    }
}

TEST(Animation, CubicTangentsAreSlopesPerSecond) {
    // Slope 0 at the ends: half-way is the mean, with the smooth-step curve between. In-tangent, value, out-tangent.
    EXPECT_FLOAT_EQ(sample_channel(channel(Interpolation::Cubic, {9, 10, 0, 0, 20, 9}), 2)[0], 15);
    EXPECT_FLOAT_EQ(sample_channel(channel(Interpolation::Cubic, {9, 10, 0, 0, 20, 9}), 1.5)[0],
                    10 + 10 * (3 * 0.0625f - 2 * 0.015625f));
    // A slope of 5 a second on both sides is the straight line from 10 to 20 in two seconds.
    EXPECT_FLOAT_EQ(sample_channel(channel(Interpolation::Cubic, {9, 10, 5, 5, 20, 9}), 1.5)[0], 12.5);
}

TEST(Animation, RotationsTakeTheShortestArc) {
    const float h = std::sqrt(0.5f);
    // Identity to a quarter turn about y, once with its sign turned round.
    for (const float sign : {1.0f, -1.0f}) {
        const auto q = sample_channel(channel(Interpolation::Linear, {0, 0, 0, 1, 0, sign * h, 0, sign * h}, 4), 2);
        EXPECT_NEAR(std::abs(q[3]), std::cos(0.3926990817), 1e-6);
        EXPECT_NEAR(q[1] / q[3], std::tan(0.3926990817), 1e-6);
    }
}

/// Makes a triangle whose node moves from (0,0,0) to (4,0,0) within two seconds.
GltfFile moving_triangle() {
    GltfFile file;
    file.add_triangle();
    file.root({{"name", "child"}});
    file.json["animations"] = {
        {{"name", "go"},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
         {"samplers",
          {{{"input", file.floats({0, 2}, "SCALAR")}, {"output", file.floats({0, 0, 0, 4, 0, 0}, "VEC3")}}}}}};
    return file;
}

TEST(Animation, NodesCamerasAndBoundsFollow) {
    GltfFile file = moving_triangle();
    file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    file.json["scenes"][0]["nodes"] = {0};
    file.json["nodes"][0]["children"] = {1};
    file.json["nodes"][0]["scale"] = {2, 2, 2};
    file.json["nodes"][1]["camera"] = 0;
    Scene scene = file.load();
    ASSERT_TRUE(scene.rig);
    ASSERT_EQ(scene.rig->animations.size(), 1u);
    EXPECT_EQ(scene.rig->animations[0].name, "go");
    EXPECT_EQ(scene.rig->animations[0].duration_s, 2);
    expect_near(vertex(scene, 1), {2, 0, 0});
    const std::uint64_t before = scene.id;
    pose(scene, 0, 1.5);
    EXPECT_NE(scene.id, before);
    expect_near(vertex(scene, 1), {5, 0, 0});  // the scale of the rest pose stays
    expect_near(scene.bounds.lo, {3, 0, 0});
    expect_near(scene.bounds.hi, {5, 2, 0});
    expect_near(glm::dvec3(scene.cameras.at(0).world[3]), {3, 0, 0});
    pose(scene, -1, 1.5);
    expect_near(vertex(scene, 1), {2, 0, 0});
    EXPECT_THROW(pose(scene, 1, 0), Error);
}

TEST(Animation, BrokenAnimationIsLeftOut) {
    GltfFile file = moving_triangle();
    file.json["animations"].push_back(file.json["animations"][0]);
    file.json["animations"][0]["samplers"][0]["output"] = file.floats({0, 0, 0}, "VEC3");
    const Scene scene = file.load();
    EXPECT_EQ(scene.rig->animations.size(), 1u);
    EXPECT_TRUE(mentions(scene.warnings, "animations[0]: a sampler's output does not fit its input"));
}

GltfFile morphing_triangle() {
    GltfFile file;
    const Json attributes = {{"POSITION", file.triangle_positions()}};
    const int lift = file.floats({0, 0, 0, 0, 0, 2, 0, 0, 0}, "VEC3"),
              widen = file.floats({0, 0, 0, 6, 0, 0, 0, 0, 0}, "VEC3");
    const int mesh =
        file.mesh({{"attributes", attributes}, {"targets", {{{"POSITION", lift}}, {{"POSITION", widen}}}}});
    file.json["meshes"][mesh]["weights"] = {0.5, 0};
    file.root({{"mesh", mesh}});
    return file;
}

TEST(Animation, MorphTargetsAddByWeight) {
    GltfFile file = morphing_triangle();
    expect_near(vertex(file.load(), 1), {1, 0, 1});
    file.json["nodes"][0]["weights"] = {1, 0.5};  // the node's win over the mesh's
    expect_near(vertex(file.load(), 1), {4, 0, 2});
    file.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
         {"samplers", {{{"input", file.floats({0, 1}, "SCALAR")}, {"output", file.floats({0, 0, 1, 1}, "SCALAR")}}}}}};
    Scene scene = file.load();
    pose(scene, 0, 0.5);
    expect_near(vertex(scene, 1), {4, 0, 1});
    // Flat normals follow: the plane through the origin, (4,0,1) and (0,1,0).
    expect_near(glm::dvec3(scene.meshes[0].normals[0]), glm::normalize(glm::dvec3(-1, 0, 4)));
}

TEST(Animation, CollapsedTriangleReturns) {
    GltfFile file = morphing_triangle();
    file.json["nodes"][0]["weights"] = {0, 0};
    const int flatten = file.floats({0, 0, 0, -1, 0, 0, 0, 0, 0}, "VEC3");
    file.json["meshes"][0]["primitives"][0]["targets"][1]["POSITION"] = flatten;
    file.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
         {"samplers", {{{"input", file.floats({0, 1}, "SCALAR")}, {"output", file.floats({0, 0, 0, 1}, "SCALAR")}}}}}};
    Scene scene = file.load();
    pose(scene, 0, 1);
    EXPECT_EQ(scene.triangle_count(), 0u);
    pose(scene, 0, 0);
    EXPECT_EQ(scene.triangle_count(), 1u);
    expect_near(vertex(scene, 1), {1, 0, 0});
}

TEST(Animation, TriangleCollapsedAtRestReturns) {
    GltfFile file = morphing_triangle();
    file.json["nodes"][0]["weights"] = {0, 1};
    const int flatten = file.floats({0, 0, 0, -1, 0, 0, 0, 0, 0}, "VEC3");
    file.json["meshes"][0]["primitives"][0]["targets"][1]["POSITION"] = flatten;
    file.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
         {"samplers", {{{"input", file.floats({0, 1}, "SCALAR")}, {"output", file.floats({0, 0, 0, 1}, "SCALAR")}}}}}};
    Scene scene = file.load();
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(scene.triangle_count(), 0u);
    EXPECT_TRUE(scene.bounds.empty());
    pose(scene, 0, 0);
    EXPECT_EQ(scene.triangle_count(), 1u);
    expect_near(vertex(scene, 1), {1, 0, 0});
    expect_near(scene.bounds.hi, {1, 1, 0});
}

/// Makes a triangle bound to two joints: corner 0 to the first, corner 1 to the second, corner 2 to both. The mesh's
/// own node is far away, which a skin ignores.
GltfFile skinned_triangle() {
    GltfFile file;
    const Json attributes = {
        {"POSITION", file.triangle_positions()},
        {"NORMAL", file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")},
        {"JOINTS_0",
         file.accessor(file.view(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}), 5121, "VEC4", 3)},
        {"WEIGHTS_0", file.floats({1, 0, 0, 0, 2, 0, 0, 0, 0.5f, 0.5f, 0, 0}, "VEC4")}};  // 2 is normalised to 1
    const int mesh = file.mesh({{"attributes", attributes}});
    file.root({{"mesh", mesh}, {"skin", 0}, {"translation", {100, 100, 100}}, {"name", "hero"}});
    file.root({{"translation", {0, 0, 5}}, {"name", "a"}});
    file.root({{"name", "b"}});
    // The second joint was bound one unit along x, so at the origin it draws its corner back to x = 0.
    file.json["skins"] = {{{"joints", {1, 2}},
                           {"inverseBindMatrices", file.floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,
                                                                1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1},
                                                               "MAT4")}}};
    return file;
}

TEST(Animation, SkinsFollowTheirJointsAndIgnoreTheirNode) {
    const Scene scene = skinned_triangle().load();
    expect_near(vertex(scene, 0), {0, 0, 5});
    expect_near(vertex(scene, 1), {0, 0, 0});
    expect_near(vertex(scene, 2), {-0.5, 1, 2.5});
    expect_near(scene.bounds.lo, {-0.5, 0, 0});
    EXPECT_EQ(scene.nodes[static_cast<std::size_t>(scene.objects[0].node)].name, "hero (skinned)");
}

// The determinant of the mesh's own node sets the winding, though the node does not move the vertices.
TEST(Animation, SkinsBelowAMirroredNodeAreMirrored) {
    GltfFile file = skinned_triangle();
    file.json["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
    const int mirror = file.append("nodes", {{"scale", {-1, 1, 1}}, {"children", {0, 1, 2}}});
    file.json["scenes"][0]["nodes"] = {mirror};
    const Scene scene = file.load();
    EXPECT_LT(glm::determinant(glm::dmat3(scene.objects.at(0).world)), 0);
    expect_near(vertex(scene, 0), {0, 0, 5});
    expect_near(vertex(scene, 1), {0, 0, 0});
    expect_near(vertex(scene, 2), {0.5, 1, 2.5});
    expect_near(scene.bounds.hi, {0.5, 1, 5});
    // The flat normal is that of the triangle without the mirror, and the object mirrors it.
    const glm::dvec3 expected = glm::normalize(glm::dvec3(2, 1, 0));
    for (const glm::vec3& n : scene.meshes[0].normals) expect_near(glm::dvec3(n), expected);
}

// A normal follows the inverse transpose: (0, 0.6, 0.8) under the scale (3, 1, 0.25) leans towards z, and a quarter
// turn about x takes z to -y and y to z.
TEST(Animation, SkinnedNormalsStayUprightUnderScale) {
    GltfFile file = skinned_triangle();
    const Json tilted = file.floats({0, 0.6f, 0.8f, 0, 0.6f, 0.8f, 0, 0.6f, 0.8f}, "VEC3");
    file.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = tilted;
    const double h = std::sqrt(0.5);
    for (int joint : {1, 2}) {
        file.json["nodes"][joint]["rotation"] = {h, 0, 0, h};
        file.json["nodes"][joint]["scale"] = {3, 1, 0.25};
    }
    const glm::dvec3 expected = glm::normalize(glm::dvec3(0, -0.8 / 0.25, 0.6));
    const Scene scene = file.load();
    for (const glm::vec3& n : scene.meshes[0].normals) expect_near(glm::dvec3(n), expected, 1e-5);
}

TEST(Animation, SkinsKeepTheirPrecisionFarFromTheOrigin) {
    GltfFile file = skinned_triangle();
    for (int joint : {1, 2}) file.json["nodes"][joint]["translation"] = {1e7, 0, joint == 1 ? 5 : 0};
    const Scene scene = file.load();
    expect_near(vertex(scene, 2), {1e7 - 0.5, 1, 2.5}, 1e-5);  // a float at 1e7 has steps of 1
}

TEST(Animation, SkinsWithBadReferencesAreRefused) {
    GltfFile file = skinned_triangle();
    file.json["skins"][0]["joints"] = {1};
    EXPECT_NE(file.error().find("joint 1 is out of range, the skin has 1"), std::string::npos) << file.error();
    file.json["skins"][0]["joints"] = {1, 9};
    EXPECT_NE(file.error().find("skins[0].joints[1]: index 9 is out of range"), std::string::npos);
}

TEST(Animation, ChannelsOfAnimationPointersAreNamed) {
    GltfFile file = skinned_triangle();
    const Json pointer = {{"path", "pointer"},
                          {"extensions", {{"KHR_animation_pointer", {{"pointer", "/nodes/0/scale"}}}}}};
    const int times = file.floats({0, 1}, "SCALAR"), places = file.floats({0, 0, 0, 1, 0, 0}, "VEC3");
    file.json["animations"] = {{{"samplers", {{{"input", times}, {"output", places}}}},
                                {"channels",
                                 {{{"sampler", 0}, {"target", pointer}},
                                  {{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}}};
    const Scene scene = file.load();
    ASSERT_TRUE(scene.rig);
    ASSERT_EQ(scene.rig->animations.size(), 1u);
    EXPECT_EQ(scene.rig->animations[0].channels.size(), 1u);
    EXPECT_TRUE(mentions(scene.warnings,
                         "animations[0]: 1 of its channels need KHR_animation_pointer, which is not supported"));
    file.json["extensionsRequired"] = {"KHR_animation_pointer"};
    EXPECT_TRUE(mentions(file.load().warnings,
                         "extensionsRequired: KHR_animation_pointer is not supported; the "
                         "properties that it animates keep their values"));
}

TEST(Animation, StaticSceneHasNoRig) {
    GltfFile file;
    file.add_triangle();
    Scene scene = file.load();
    EXPECT_FALSE(scene.rig);
    const std::uint64_t id = scene.id;
    pose(scene, 0, 1);
    EXPECT_EQ(scene.id, id);
}

}  // namespace
}  // namespace si::test
