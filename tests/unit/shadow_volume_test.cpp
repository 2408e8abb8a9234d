// Tests of shadow volumes without a GPU: how often their boundary encloses a point, compared with counted triangles.
#include "renderer/view/lights/shadow_volume.h"

#include <gtest/gtest.h>

#include "renderer/scenes/shapes.h"

namespace si {
namespace {

constexpr double kFarAway_m = 1e4;

struct Ws {
    glm::dvec3 a, b, c;
};

/// Returns 1 if the line from p along d leaves through the triangle's front, -1 if it enters, 0 if it misses.
int crossing(const Ws& t, const glm::dvec3& p, const glm::dvec3& d) {
    const glm::dvec3 e1 = t.b - t.a, e2 = t.c - t.a, h = glm::cross(d, e2);
    const double det = glm::dot(e1, h);
    if (det == 0) return 0;
    const glm::dvec3 s = p - t.a, q = glm::cross(s, e1);
    const double u = glm::dot(s, h) / det, v = glm::dot(d, q) / det, along = glm::dot(e2, q) / det;
    if (u < 0 || v < 0 || u + v > 1 || along <= 0) return 0;
    return det < 0 ? 1 : -1;
}

class Volume {
public:
    /// Builds the volume of a mesh. @param capped adds dark caps under parallel light
    Volume(const Mesh& mesh, const glm::dmat4& world, const VolumeLight& light, bool capped = false)
        : mesh_(mesh), light_(light) {
        VolumeTriangles found;
        add_shadow_volume(mesh_, world, light, capped || !light.parallel, found);
        for (const VolumeMesh::Triangle& t : mesh_.triangles) {
            const auto at = [&](std::size_t k) { return place(world, 2 * t.corners[k]); };
            casters_.push_back({at(0), at(1), at(2)});
        }
        const auto add = [&](const std::vector<std::uint32_t>& list, bool turned) {
            for (std::size_t i = 0; i + 2 < list.size(); i += 3) {
                Ws t{place(world, list[i]), place(world, list[i + 1]), place(world, list[i + 2])};
                if (turned) std::swap(t.b, t.c);
                faces_.push_back(t);
            }
        };
        add(found.caps, false);
        add(found.clockwise_caps, true);
        add(found.rest, false);
        sides = found.rest.size() / 3;
    }
    /// Returns how many times the boundary encloses the point.
    int encloses(const glm::dvec3& p, const glm::dvec3& along) const {
        int sum = 0;
        for (const Ws& t : faces_) sum += crossing(t, p, along);
        return sum;
    }
    /// Returns how many triangles are between the point and the light.
    int between(const glm::dvec3& p) const {
        const glm::dvec3 d = light_.parallel ? light_.to_light * kFarAway_m : light_.position_ws - p;
        int sum = 0;
        for (const Ws& t : casters_) {
            const bool before = crossing(t, p, d) != 0, behind = crossing(t, p + d, d) != 0;
            sum += before && !behind;
        }
        return sum;
    }
    const VolumeMesh& mesh() const { return mesh_; }
    std::size_t sides = 0;

private:
    VolumeMesh mesh_;
    VolumeLight light_;
    std::vector<Ws> casters_, faces_;

    glm::dvec3 place(const glm::dmat4& world, std::uint32_t v) const {
        const glm::dvec3 at(world * glm::dvec4(glm::dvec3(mesh_.positions[v / 2]), 1));
        if (v % 2 == 0) return at;
        return at + kFarAway_m * (light_.parallel ? -light_.to_light : glm::normalize(at - light_.position_ws));
    }
};

/// Makes a mesh whose triangles face inwards.
Mesh inside_out(Mesh mesh) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        std::swap(mesh.indices.edit()[i], mesh.indices.edit()[i + 1]);
    return mesh;
}

Mesh joined_meshes(Mesh a, const Mesh& b) {
    append(a, b);
    return a;
}

/// Makes three sheets that share an edge.
Mesh fan() {
    return make_polygons("fan", {{{0, -1, 0}, {2, -1, 0}, {2, 1, 0}, {0, 1, 0}},
                                 {{0, -1, 0}, {-1, -1, 2}, {-1, 1, 2}, {0, 1, 0}},
                                 {{0, -1, 0}, {0, 1, 0}, {-1, 1, -2}, {-1, -1, -2}}});
}

struct Case {
    const char* name;
    Mesh mesh;
    std::size_t open;  ///< number of triangles
    bool exact;        ///< all triangles count; otherwise only those that face one way
};

std::vector<Case> cases() {
    Mesh lidless = make_box({2, 2, 2});
    lidless.indices.resize(lidless.indices.size() - 6);
    return {{"box", make_box({2, 1, 3}), 0, false},
            {"box inside out", inside_out(make_box({2, 1, 3})), 0, false},
            {"ring", make_torus(1.5, 0.4, 12, 8), 0, false},
            {"sheet", make_plane(2, 3, 2, 2), 8, true},
            {"box without a side", lidless, 10, true},
            {"sheets that share an edge", fan(), 6, true},
            {"box and sheet", joined_meshes(make_box({1, 1, 1}), make_plane(4, 4)), 2, false}};
}

TEST(ShadowVolume, EnclosesAPointOncePerOccluder) {
    Random random(7);
    const glm::dmat4 mirrored = moved(3e3, -5e2, 8e3) * turned(33, {1, 2, 3}) * scaled(-1.2, 1, 0.7);
    for (const Case& c : cases())
        for (const glm::dmat4& world : {glm::dmat4(1), mirrored})
            for (const auto& [parallel, capped] : {std::pair{true, false}, {true, true}, {false, true}})
                for (int l = 0; l < 6; ++l) {
                    SCOPED_TRACE(testing::Message() << c.name << " " << parallel << " " << capped << " " << l);
                    const glm::dvec3 centre(world[3]);
                    // The first directions are exactly along the axes: sides of boxes are edge-on.
                    const glm::dvec3 axes[] = {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}};
                    const glm::dvec3 towards = l < 3 ? axes[l] : random.direction();
                    const VolumeLight light{parallel, towards, centre + 5.0 * towards};
                    const Volume volume(c.mesh, world, light, capped);
                    EXPECT_EQ(volume.mesh().open_triangles, c.open);
                    int shadowed = 0, off = 0;
                    for (int i = 0; i < 300; ++i) {
                        const glm::dvec3 p = centre + 2.5 * random.in(0, 1) * random.direction() - 1.5 * towards;
                        // Lines without caps must not leave through the open far end.
                        const glm::dvec3 along =
                            capped ? random.direction() : glm::normalize(random.direction() + 1.5 * towards);
                        const int is = volume.encloses(p, along), reference = volume.between(p);
                        shadowed += reference > 0;
                        off += c.exact ? is != reference : (is > 0) != (reference > 0) || is < 0;
                    }
                    EXPECT_EQ(off, 0);
                    if (c.mesh.indices.size() > 30) {
                        EXPECT_GT(shadowed, 20);
                    }
                }
}

// Joined triangles share their sides: a closed surface has sides at its silhouette only.
TEST(ShadowVolume, OnlySilhouettesHaveSides) {
    const VolumeLight sun{true, glm::normalize(glm::dvec3(0.3, 1, 0.2)), {}};
    EXPECT_EQ(Volume(make_box({1, 1, 1}), glm::dmat4(1), sun).sides, 6u) << "the hexagon that a cube's outline is";
    EXPECT_EQ(Volume(make_plane(2, 2, 5, 5), glm::dmat4(1), sun).sides, 20u) << "the rim, not the cells";
    const VolumeLight lamp{false, {0, 1, 0}, {0.3, 9, 0.2}};
    // Two triangles a side and a dark cap: the rim of the top side is the silhouette.
    EXPECT_EQ(Volume(make_box({8, 1, 8}), glm::dmat4(1), lamp).sides, 4u * 2 + 2u);
}

TEST(ShadowVolume, CoveredPixelsMatchTheProjectedTriangle) {
    const auto at = [](double x, double y, double w) { return glm::dvec4(x * w, y * w, 0, w); };
    EXPECT_NEAR(covered_pixels({at(-1, -1, 1), at(1, -1, 7), at(-1, 1, 0.3)}, 200, 100), 10000, 1e-6) << "half of it";
    EXPECT_NEAR(covered_pixels({at(-9, -9, 1), at(9, -9, 1), at(0, 30, 2)}, 200, 100), 20000, 1e-6) << "all of it";
    EXPECT_EQ(covered_pixels({at(2, 2, 1), at(3, 2, 1), at(2, 3, 1)}, 200, 100), 0);
    // A corner endlessly far along x: the strip from x = 0 on, half as high at its end.
    EXPECT_NEAR(covered_pixels({at(0, -1, 1), glm::dvec4(1, 0, 0, 0), at(0, 1, 1)}, 200, 100), 10000, 1e-6);
    EXPECT_EQ(covered_pixels({at(0, 0, -1), at(1, 0, -1), at(0, 1, -1)}, 200, 100), 0) << "behind the camera";
}

}  // namespace
}  // namespace si
