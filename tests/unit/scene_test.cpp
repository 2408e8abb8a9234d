// Tests of finalise(), bounds and basic shapes.
#include "renderer/scene/scene.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "renderer/base/error.h"
#include "renderer/scenes/shapes.h"
#include "renderer/scenes/teapot.h"
#include "tests/support/mesh_scene.h"

namespace si {
namespace {

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();
constexpr float kEndless = std::numeric_limits<float>::infinity();

/// Makes two triangles of a unit square in the plane z = 0, without normals.
Mesh square() {
    Mesh mesh;
    mesh.name = "square";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

/// Makes a scene of one object per mesh, without finalising it.
Scene scene_of(const std::vector<Mesh>& meshes) {
    Scene scene;
    for (const Mesh& mesh : meshes) {
        scene.meshes.push_back(mesh);
        add_object(scene, mesh.name, -1, int(scene.meshes.size()) - 1);
    }
    return scene;
}

Scene finalised(Scene scene) {
    finalise(scene);
    return scene;
}
Scene finalised(const std::vector<Mesh>& meshes) {
    return finalised(scene_of(meshes));
}

double signed_volume(const Mesh& mesh) {
    double volume = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
            c(mesh.positions[mesh.indices[i + 2]]);
        volume += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return volume;
}

/// Returns how many directed edges, between positions, lack exactly one partner in the other direction.
std::size_t open_edges(const Mesh& mesh) {
    using Key = std::tuple<float, float, float>;
    std::map<Key, int> ids;
    const auto id = [&](std::uint32_t index) {
        const glm::vec3 p = mesh.positions[index] + 0.0f;  // -0 and 0 are one place
        return ids.try_emplace(Key(p.x, p.y, p.z), int(ids.size())).first->second;
    };
    std::map<std::pair<int, int>, int> edges;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) ++edges[{id(mesh.indices[i + k]), id(mesh.indices[i + (k + 1) % 3])}];
    std::size_t open = 0;
    for (const auto& [edge, count] : edges) {
        const auto back = edges.find({edge.second, edge.first});
        open += count != 1 || back == edges.end() || back->second != 1;
    }
    return open;
}

/// Returns how many corners have a normal that is not of unit length or points against its triangle's front.
std::size_t wrong_normals(const Mesh& mesh) {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto p = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
        const glm::dvec3 face = glm::normalize(glm::cross(p(1) - p(0), p(2) - p(0)));
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 n(mesh.normals[mesh.indices[i + k]]);
            wrong += !(std::abs(glm::length(n) - 1) < 1e-5) || !(glm::dot(n, face) > 0);
        }
    }
    return wrong;
}

TEST(Bounds, TransformedHoldsTheEightCorners) {
    const Bounds box{{-1, 2, -3}, {4, 5, 6}};
    const glm::dmat4 m = moved(7, -8, 9) * turned(33, glm::normalize(glm::dvec3(1, 2, 3))) * scaled(2, -1, 0.5);
    Bounds expected;
    for (int corner = 0; corner < 8; ++corner)
        expected.add(glm::dvec3(m * glm::dvec4(corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                                               corner & 4 ? box.hi.z : box.lo.z, 1)));
    const Bounds got = box.transformed(m);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(got.lo[axis], expected.lo[axis], 1e-12);
        EXPECT_NEAR(got.hi[axis], expected.hi[axis], 1e-12);
    }
    EXPECT_TRUE(Bounds{}.transformed(m).empty());
}

TEST(Finalise, MakesMissingNormalsFlatAndKeepsAttributesAligned) {
    Mesh bent = square();
    bent.positions.edit()[3] = {0, 1, 1};
    const Scene scene = finalised({bent});
    const Mesh& mesh = scene.meshes[0];
    ASSERT_EQ(mesh.positions.size(), 6u);
    ASSERT_EQ(mesh.normals.size(), 6u);
    ASSERT_EQ(mesh.uv.size(), 6u);
    EXPECT_EQ(wrong_normals(mesh), 0u);
    EXPECT_NE(mesh.normals[0], mesh.normals[3]);
    EXPECT_EQ(mesh.uv[5], glm::vec2(0, 1));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(Finalise, ReplacesNormalsWithoutDirection) {
    for (const glm::vec3 bad : {glm::vec3(0), glm::vec3(kNoNumber, 0, 1), glm::vec3(kEndless, 0, 0)}) {
        Mesh mesh = square();
        mesh.normals.assign(4, glm::vec3(0, 0, 1));
        mesh.normals.edit()[2] = bad;
        const Scene scene = finalised({mesh});
        EXPECT_EQ(wrong_normals(scene.meshes[0]), 0u);
        ASSERT_EQ(scene.warnings.size(), 1u);
        EXPECT_NE(scene.warnings[0].find("'square'"), std::string::npos);
    }
}

TEST(Finalise, NormalisesLongNormals) {
    Mesh mesh = square();
    mesh.normals.assign(4, glm::vec3(0, 0, 3));
    const Scene scene = finalised({mesh});
    EXPECT_EQ(scene.meshes[0].normals[1], glm::vec3(0, 0, 1));
    EXPECT_EQ(scene.meshes[0].positions.size(), 4u);
}

TEST(Finalise, DropsTrianglesWithoutArea) {
    Mesh mesh = square();
    mesh.positions.push_back({2, 0, 0});
    // Two equal corners; three corners on a line.
    mesh.uv.push_back({0, 0});
    mesh.indices.append({1, 1, 2, 0, 1, 4});
    const Scene scene = finalised({mesh, square()});
    EXPECT_EQ(scene.dropped_triangles, 2u);
    EXPECT_EQ(scene.triangle_count(), 4u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("2 triangles without area"), std::string::npos);
    EXPECT_EQ(scene.bounds.hi.x, 1);  // vertices of dropped triangles alone do not count
}

/// Makes 1000 triangles in a row along x, each with its own vertices, one corner at y = 1.
Mesh row_of_triangles(std::size_t count = 1000) {
    Mesh mesh;
    mesh.name = "row";
    for (std::size_t i = 0; i < count; ++i) {
        const float x = float(i);
        for (const glm::vec3& p : {glm::vec3(x, 0, 0), glm::vec3(x + 0.5f, 0, 0), glm::vec3(x, 1, 0)}) {
            mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
            mesh.positions.push_back(p);
            mesh.normals.emplace_back(0, 0, 1);
        }
    }
    return mesh;
}

TEST(Finalise, DropsTrianglesWithoutAreaWhereverTheyStand) {
    for (const std::size_t count : {1u, 15u, 16u, 17u, 1000u})
        for (const std::size_t every : {1u, 2u, 7u, 16u, 100u, 999u}) {
            Mesh mesh = row_of_triangles(count);
            std::vector<std::uint32_t> kept;
            for (std::size_t t = 0; t < count; ++t) {
                const bool flat = t % every == 0;  // its corners are on a line along none of the axes
                for (std::size_t k = 0; k < 3; ++k)
                    if (flat)
                        mesh.positions.edit()[3 * t + k] = float(k) * glm::vec3(0.1f, 0.3f, 0.7f);
                    else
                        kept.push_back(std::uint32_t(3 * t + k));
            }
            const Scene scene = finalised({mesh});
            EXPECT_EQ(scene.dropped_triangles, (count + every - 1) / every) << count << " every " << every;
            ASSERT_EQ(scene.meshes.empty(), kept.empty());
            if (kept.empty()) continue;
            EXPECT_EQ(scene.meshes[0].indices, kept) << count << " every " << every;
            const double first = kept.front() / 3, last = kept.back() / 3 + 0.5;
            EXPECT_EQ(scene.meshes[0].bounds.lo, glm::dvec3(first, 0, 0)) << "of what is left only";
            EXPECT_EQ(scene.meshes[0].bounds.hi, glm::dvec3(last, 1, 0)) << count << " every " << every;
        }
}

TEST(Finalise, KeepsSliversAndTrianglesOfEverySize) {
    for (const float size : {1e-19f, 1e-8f, 1.0f, 1e8f, 1e17f}) {
        Mesh mesh = row_of_triangles(100);
        for (glm::vec3& p : mesh.positions.edit()) p *= size;
        const Scene scene = finalised({mesh});
        EXPECT_EQ(scene.dropped_triangles, 0u) << size;
        EXPECT_EQ(scene.meshes.at(0).indices.size(), 300u);
    }
    Mesh slivers = row_of_triangles(100);  // height is a ten-millionth of the width
    for (glm::vec3& p : slivers.positions.edit()) p.y *= 0.5e-7f;
    const Scene scene = finalised({slivers});
    EXPECT_EQ(scene.dropped_triangles, 0u);
}

TEST(Finalise, BoundsLeaveOutVerticesWithoutTriangles) {
    Mesh mesh = row_of_triangles(40);
    mesh.positions.emplace_back(1e6f, -1e6f, 5);
    mesh.normals.emplace_back(0, 0, 0);  // a zero normal of an unused vertex
    const Scene scene = finalised({mesh});
    EXPECT_EQ(scene.meshes[0].bounds.hi, glm::dvec3(39.5, 1, 0));
    EXPECT_EQ(scene.meshes[0].bounds.lo, glm::dvec3(0));
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.meshes[0].normals[0], glm::vec3(0, 0, 1));
}

TEST(Finalise, KeepsTinyTriangles) {
    Mesh mesh = square();
    for (glm::vec3& p : mesh.positions.edit()) p *= 1e-20f;
    const Scene scene = finalised({mesh});
    EXPECT_EQ(scene.triangle_count(), 2u);
    EXPECT_EQ(wrong_normals(scene.meshes[0]), 0u);
}

TEST(Finalise, DropsMeshesThatAreNotFinite) {
    Mesh bad = square();
    bad.name = "bad";
    bad.positions.edit()[1].y = kNoNumber;
    Mesh last = square();
    last.name = "last";
    const Scene scene = finalised({square(), bad, last});
    ASSERT_EQ(scene.meshes.size(), 2u);
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.meshes[scene.objects[1].mesh].name, "last");
    EXPECT_EQ(scene.nodes[scene.objects[1].node].path, "last");
    EXPECT_EQ(scene.bounds.hi, glm::dvec3(1, 1, 0));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("'bad'"), std::string::npos);
}

TEST(Finalise, IgnoresAttributesThatAreNotFinite) {
    Mesh mesh = square();
    mesh.uv.edit()[0].x = kEndless;
    mesh.colours.assign(4, glm::vec4(1, 1, 1, kNoNumber));
    const Scene scene = finalised({mesh});
    EXPECT_TRUE(scene.meshes[0].uv.empty());
    EXPECT_TRUE(scene.meshes[0].colours.empty());
    EXPECT_EQ(scene.warnings.size(), 2u);
    EXPECT_EQ(scene.triangle_count(), 2u);
}

TEST(Finalise, RefusesReferencesOutOfRange) {
    const auto refuses = [](auto&& spoil) {
        Scene scene = scene_of({square()});
        spoil(scene);
        EXPECT_THROW(finalise(scene), Error);
    };
    refuses([](Scene& s) { s.meshes[0].indices.edit()[4] = 4; });
    for (const std::size_t at : {0u, 150u, 299u})
        refuses([at](Scene& s) {
            s.meshes[0] = row_of_triangles(100);
            s.meshes[0].indices.edit()[at] = 300;
        });
    refuses([](Scene& s) { s.meshes[0].indices.edit().pop_back(); });
    refuses([](Scene& s) { s.meshes[0].uv.edit().pop_back(); });
    refuses([](Scene& s) { s.meshes[0].material = 0; });
    refuses([](Scene& s) { s.meshes[0].material = -2; });
    refuses([](Scene& s) { s.objects[0].mesh = 1; });
    refuses([](Scene& s) { s.objects[0].node = -1; });
    refuses([](Scene& s) { s.nodes[0].parent = 0; });
    refuses([](Scene& s) {
        add_material(s, "m", {});
        s.materials[0].base_colour_texture = 0;
    });
    refuses([](Scene& s) {
        s.textures.resize(1);
        s.textures[0].width = s.textures[0].height = 2;
    });
}

TEST(Finalise, GivesNodesUniquePathsAndWorldTransforms) {
    Scene scene = scene_of({square()});
    scene.nodes.clear();
    const int a = add_node(scene, "A", -1, moved(1, 0, 0));
    const int b = add_node(scene, "B/C", a, turned(90));
    scene.objects[0].node = b;
    scene.objects[0].instance = moved(0, 0, 2);
    add_node(scene, "A");
    add_node(scene, "A");
    add_node(scene, "A #2");
    add_node(scene, "", a);
    finalise(scene);
    EXPECT_EQ(scene.nodes[b].path, "A/B_C");
    EXPECT_EQ(scene.nodes[2].path, "A #2");
    EXPECT_EQ(scene.nodes[3].path, "A #3");
    EXPECT_EQ(scene.nodes[4].path, "A #2 #2");
    EXPECT_EQ(scene.nodes[5].path, "A/node 5");
    // +z turned by 90 degrees about +y is +x.
    EXPECT_NEAR(glm::length(glm::dvec3(scene.objects[0].world[3]) - glm::dvec3(3, 0, 0)), 0, 1e-12);
    EXPECT_NEAR(scene.bounds.hi.x, 3, 1e-12);
}

TEST(Finalise, DropsObjectsWithoutAPlaceAndKeepsFlatOnes) {
    Scene scene = scene_of({square(), square(), square(), square()});
    scene.nodes[0].local[3].x = kEndless;
    scene.nodes[1].local = scaled(1, 0, 1);
    scene.nodes[2].local = scaled(1e300, 1e300, 1e300) * scaled(1e300, 1, 1);
    finalise(scene);
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[0].node, 1);
    EXPECT_EQ(scene.bounds.hi, glm::dvec3(1, 1, 0));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("and 1 more"), std::string::npos);
}

TEST(Finalise, GivesEachSceneItsOwnId) {
    Scene a = scene_of({square()}), b = a;
    finalise(a);
    finalise(b);
    EXPECT_NE(a.id, 0u);
    EXPECT_NE(a.id, b.id);
}

TEST(Finalise, TakesFiftyThousandEqualNamesAndADeepChain) {
    Scene scene = scene_of({square()});
    for (int i = 0; i < 50000; ++i) add_object(scene, "same", -1, 0, moved(i, 0, 0));
    for (int i = 0; i < 50000; ++i) add_node(scene, "link", int(scene.nodes.size()) - 1);
    const auto start = std::chrono::steady_clock::now();
    finalise(scene);
    // About 0.1 s; comparing all pairs of names, or keeping whole paths, would take minutes or gigabytes.
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
    std::set<std::string> paths;
    for (const Node& node : scene.nodes) paths.insert(node.path);
    EXPECT_EQ(paths.size(), scene.nodes.size());
    EXPECT_EQ(scene.triangle_count(), 2u * 50001);
}

TEST(Shapes, ClosedOnesAreWatertightAndFaceOutwards) {
    using std::numbers::pi;
    struct Case {
        Mesh mesh;
        double volume, tolerance;  ///< volume of the smooth body; the polygons are inside
    };
    const Case cases[] = {
        {make_box({1, 2, 3}), 6, 1e-6},
        {make_wedge({2, 1, 3}), 3, 1e-6},
        {make_sphere(2), 4.0 / 3 * pi * 8, 0.02},
        {make_cylinder(0.5, 3), pi * 0.25 * 3, 0.02},
        {make_cylinder(1, 2, 64, 0.25), pi * 2 / 3 * (1 + 0.25 + 0.0625), 0.02},
        {make_capsule(0.5, 2, 32), pi * 0.25 * 2 + 4.0 / 3 * pi * 0.125, 0.03},
        {make_torus(2, 0.5), 2 * pi * pi * 2 * 0.25, 0.03},
        {transformed(make_torus(1, 0.25), turned(40, {1, 0, 0}) * scaled(3, 1, 1)), 3 * 2 * pi * pi * 0.0625, 0.03},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.mesh.name);
        EXPECT_EQ(open_edges(c.mesh), 0u);
        EXPECT_EQ(wrong_normals(c.mesh), 0u);
        EXPECT_NEAR(signed_volume(c.mesh) / c.volume, 1, c.tolerance);
        const Scene scene = make_scene(c.mesh);
        EXPECT_EQ(scene.dropped_triangles, 0u);
        EXPECT_TRUE(scene.warnings.empty());
    }
}

TEST(Shapes, OpenOnesAreOpenAndFaceTheirWay) {
    const Mesh plane = make_plane(4, 2, 3, 2), quad = make_quad(3, 2);
    EXPECT_EQ(open_edges(plane), 10u);
    EXPECT_EQ(open_edges(quad), 4u);
    EXPECT_EQ(wrong_normals(plane), 0u);
    EXPECT_EQ(wrong_normals(quad), 0u);
    EXPECT_EQ(plane.normals[0], glm::vec3(0, 1, 0));
    EXPECT_EQ(quad.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(make_scene(quad).bounds.lo, glm::dvec3(-1.5, 0, 0));
}

TEST(Teapot, HasTheKnownExtentAndNormals) {
    const Mesh teapot = make_teapot(16);
    EXPECT_EQ(teapot.positions.size(), 32u * 17 * 17);
    // Eight patches, of knob and bottom, shrink to a point on one side and lose a row of 16 triangles there.
    EXPECT_EQ(teapot.indices.size() / 3, 32u * 16 * 16 * 2 - 8 * 16);
    EXPECT_EQ(wrong_normals(teapot), 0u);
    const Scene scene = make_scene(teapot);
    EXPECT_EQ(scene.dropped_triangles, 0u);
    EXPECT_NEAR(scene.bounds.lo.x, -3.0, 1e-6);
    EXPECT_NEAR(scene.bounds.hi.x, 3.434, 1e-3);
    EXPECT_NEAR(scene.bounds.lo.y, 0, 1e-6);
    EXPECT_NEAR(scene.bounds.hi.y, 3.15, 1e-6);
    EXPECT_NEAR(scene.bounds.hi.z, 2, 1e-6);
    // Normals of all patches equal the axis where the patches shrink to a point, on top of knob and bottom.
    std::size_t poles = 0;
    for (std::size_t i = 0; i < teapot.positions.size(); ++i) {
        const glm::vec3& p = teapot.positions[i];
        if (p != glm::vec3(0, 3.15f, 0) && p != glm::vec3(0)) continue;
        ++poles;
        EXPECT_NEAR(teapot.normals[i].y, p.y > 1 ? 1 : -1, 1e-6);
    }
    EXPECT_EQ(poles, 8u * 17);
}

TEST(Teapot, NeighbouringPatchesMeetWithEqualNormals) {
    const Mesh teapot = make_teapot(8);
    std::map<std::tuple<int, int, int>, std::vector<glm::vec3>> places;
    for (std::size_t i = 0; i < teapot.positions.size(); ++i) {
        const glm::ivec3 p(glm::round(teapot.positions[i] * 1e5f));
        places[{p.x, p.y, p.z}].push_back(teapot.normals[i]);
    }
    std::size_t shared = 0, creased = 0;
    for (const auto& [place, normals] : places)
        for (std::size_t i = 1; i < normals.size(); ++i) {
            ++shared;
            creased += glm::dot(normals[i], normals[0]) < 0.98f;
        }
    // The data are smooth across patches except at single points.
    EXPECT_GT(shared, 500u);
    EXPECT_LE(creased, 4u);
}

}  // namespace
}  // namespace si
