// Tests of face normals carried by the last corner of each triangle.
#include "renderer/scene/face_normals.h"

#include <gtest/gtest.h>

#include <set>

#include "renderer/scenes/shapes.h"
#include "renderer/scenes/teapot.h"
#include "tests/support/traits.h"

namespace si {
namespace {

/// Returns the mesh's triangles, each rotated to start with its least corner: rotation is ignored, mirroring is not.
std::vector<std::array<std::uint32_t, 3>> triangles(std::span<const std::uint32_t> indices, auto&& vertex_of) {
    std::vector<std::array<std::uint32_t, 3>> out;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        std::array<std::uint32_t, 3> t{vertex_of(indices[i]), vertex_of(indices[i + 1]), vertex_of(indices[i + 2])};
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        out.push_back(t);
    }
    return out;
}

SI_TESTS_ARE(Repeated, FaceNormals);
TEST(FaceNormals, LastCornersCarryThemAndTrianglesStay) {
    for (const Mesh& mesh :
         {make_sphere(1), make_box(glm::dvec3(1)), make_capsule(0.3, 1), make_plane(2, 3), make_teapot()}) {
        const FlatNormalMesh faced = face_normals(mesh.positions, mesh.indices);
        const std::size_t own = mesh.positions.size();
        ASSERT_EQ(faced.normals.size(), own + faced.copies.size());
        const auto original = [&](std::uint32_t v) { return v < own ? v : faced.copies[v - own]; };
        EXPECT_EQ(triangles(faced.indices, original), triangles(mesh.indices, [](std::uint32_t v) { return v; }));
        double worst = 0;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const auto at = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
            const glm::dvec3 n = glm::cross(at(1) - at(0), at(2) - at(0));
            const glm::dvec3 carried(faced.normals[faced.indices[i + 2]]);
            worst =
                std::max(worst, glm::length(n) > 0 ? glm::length(carried - glm::normalize(n)) : glm::length(carried));
        }
        EXPECT_LT(worst, 1e-7);
        EXPECT_LE(own + faced.copies.size(), std::max(own, mesh.indices.size() / 3) * 1.1)
            << "copies where none are due";
    }
}

// Eight corners, twelve triangles, six normals.
TEST(FaceNormals, SharedCornersCarryOneNormalEach) {
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1, i >> 1 & 1, i >> 2);
    const std::vector<std::uint32_t> cube{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                          2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    const FlatNormalMesh faced = face_normals(corners, cube);
    EXPECT_LE(faced.copies.size(), 4u);
    std::set<std::array<float, 3>> carried;
    for (std::size_t i = 2; i < faced.indices.size(); i += 3) {
        const glm::vec3 n = faced.normals[faced.indices[i]];
        carried.insert({n.x, n.y, n.z});
    }
    EXPECT_EQ(carried.size(), 6u);
}

}  // namespace
}  // namespace si
