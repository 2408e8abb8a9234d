// Tests of the watertight check: maps may leave back faces out for closed meshes only.
#include <gtest/gtest.h>

#include <algorithm>

#include "renderer/scene/watertight.h"
#include "renderer/scenes/builtin.h"
#include "renderer/scenes/shapes.h"

namespace si {
namespace {

bool is_closed(const Mesh& m) {
    return check_watertight(m.positions, m.indices).closed;
}

Mesh turned_inside_out(Mesh m) {
    for (std::size_t i = 0; i + 2 < m.indices.size(); i += 3) std::swap(m.indices.edit()[i], m.indices.edit()[i + 1]);
    return m;
}

/// Makes two square rings joined into a tube that crosses itself: consistent winding, but partly inside out.
Mesh bow_tie() {
    const std::vector<glm::dvec3> low = {{-1, 0, -1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, 0.5}};
    std::vector<glm::dvec3> high = low;
    for (glm::dvec3& p : high) p.y = 1;
    std::vector<std::vector<glm::dvec3>> faces = {{high[0], high[1], high[2], high[3]},
                                                  {low[3], low[2], low[1], low[0]}};
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t k = (i + 1) % 4;
        faces.push_back({low[i], low[k], high[k], high[i]});
    }
    return make_polygons("bow tie", faces);
}

TEST(WatertightCheck, AcceptsClosedShapes) {
    EXPECT_TRUE(is_closed(make_box({1, 2, 3})));
    EXPECT_TRUE(is_closed(make_wedge({1, 2, 3})));
    EXPECT_TRUE(is_closed(make_sphere(2)));
    EXPECT_TRUE(is_closed(make_torus(2, 0.5)));
    EXPECT_TRUE(is_closed(make_cylinder(1, 2)));
    EXPECT_TRUE(is_closed(make_capsule(1, 2)));
}

TEST(WatertightCheck, AcceptsOverlappingBodies) {
    Mesh two = make_box({1, 1, 1});
    append(two, transformed(make_torus(1, 0.3), moved(0.4, 0.1, 0.2)));
    EXPECT_TRUE(is_closed(two));
}

TEST(WatertightCheck, RejectsOpenBodies) {
    EXPECT_FALSE(is_closed(make_plane(2, 2, 4, 4)));
    Mesh lidless = make_box({1, 1, 1});
    lidless.indices.resize(lidless.indices.size() - 6);
    EXPECT_FALSE(is_closed(lidless));
    Mesh torn = make_box({1, 1, 1});
    torn.positions.edit()[torn.indices[0]] += glm::vec3(0, 1e-4f, 0);
    EXPECT_FALSE(is_closed(torn)) << "a vertex of one of several that stood in one place was moved";
    Mesh doubled = make_box({1, 1, 1});
    append(doubled, make_box({1, 1, 1}));
    EXPECT_FALSE(is_closed(doubled)) << "each edge is there twice, each way";
    Mesh thrice = make_box({1, 1, 1});
    for (std::size_t i = 0; i < 3; ++i) thrice.indices.push_back(thrice.indices[i]);
    EXPECT_FALSE(is_closed(thrice)) << "a triangle is there twice";
}

TEST(WatertightCheck, RejectsInvertedAndSelfIntersectingBodies) {
    EXPECT_FALSE(is_closed(turned_inside_out(make_sphere(1))));
    Mesh one_wrong = make_box({1, 1, 1});
    std::swap(one_wrong.indices.edit()[0], one_wrong.indices.edit()[1]);
    EXPECT_FALSE(is_closed(one_wrong));
    Mesh hollow = make_sphere(2);
    append(hollow, turned_inside_out(make_sphere(1)));
    EXPECT_FALSE(is_closed(hollow));
    EXPECT_FALSE(is_closed(bow_tie()));
    EXPECT_FALSE(is_closed(make_torus(1, 1.4))) << "its tube passes through its axis";
}

TEST(WatertightCheck, RejectsFlatAndEmptyBodies) {
    Mesh flat = make_box({1, 0, 1});
    EXPECT_FALSE(is_closed(flat));
    EXPECT_FALSE(check_watertight({}, {}).closed);
}

TEST(WatertightCheck, JoinsSeamsOpenedByRounding) {
    Mesh ball = make_sphere(1);
    EXPECT_TRUE(check_watertight(ball.positions, ball.indices).joined.empty());
    const glm::vec3 place = ball.positions[ball.indices[300]];
    const std::uint32_t moved_one = ball.indices[300];
    ball.positions.push_back(place + glm::vec3(0, 4e-7f, 0));
    ball.indices.edit()[300] = std::uint32_t(ball.positions.size() - 1);
    if (!ball.normals.empty()) ball.normals.push_back(ball.normals[moved_one]);
    const WatertightCheck bodies = check_watertight(ball.positions, ball.indices);
    ASSERT_TRUE(bodies.closed);
    ASSERT_EQ(bodies.joined.size(), 1u);
    const auto [vertex, there] = bodies.joined[0];
    EXPECT_NE(ball.positions[vertex], ball.positions[there]);
    EXPECT_LT(glm::distance(ball.positions[vertex], ball.positions[there]), 1e-6);
}

TEST(WatertightCheck, AcceptsTheBodiesOfBuiltInScenes) {
    const Scene boxes = load_scene("boxes");
    const auto closed = std::count_if(boxes.meshes.begin(), boxes.meshes.end(), is_closed);
    EXPECT_GE(closed, 1);
    EXPECT_LE(std::size_t(closed), boxes.meshes.size());
}

}  // namespace
}  // namespace si
