#include "renderer/view/lights/shadow_volume.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <tuple>

#include "renderer/scene/face_normals.h"

namespace si {
namespace {

/// Returns for each vertex the index of the first vertex at the same place.
std::vector<std::uint32_t> welded(const std::vector<glm::vec3>& positions, std::vector<glm::vec3>& unique) {
    std::vector<std::uint32_t> order(positions.size()), out(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) {
        const glm::vec3 p = positions[i] + 0.f;  // turns -0 into 0
        return std::tuple(p.x, p.y, p.z);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || key(order[i]) != key(order[i - 1])) unique.push_back(positions[order[i]]);
        out[order[i]] = std::uint32_t(unique.size()) - 1;
    }
    return out;
}

/// Disjoint sets with union. Tarjan, Efficiency of a Good But Not Linear Set Union Algorithm, 1975.
class Sets {
public:
    explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t of(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent_[of(a)] = of(b); }

private:
    std::vector<std::uint32_t> parent_;
};

/// Side of a triangle, sorted by its corners to find adjacent triangles.
struct Side {
    std::uint32_t lo, hi, triangle;
    std::uint8_t k;  ///< side 0 to 2
    bool upwards;    ///< runs from lo to hi
};

}  // namespace

VolumeMesh::VolumeMesh(const Mesh& mesh) {
    const std::vector<std::uint32_t> unique = welded(mesh.positions, positions);
    // Duplicate vertices of the renderer have the places of their originals and are left out.
    const FlatNormalMesh faced = face_normals(mesh.positions, mesh.indices);
    const auto source = [&](std::uint32_t v) {
        return unique[v < mesh.positions.size() ? v : faced.copies[v - mesh.positions.size()]];
    };
    std::vector<Side> sides;
    for (std::size_t i = 0; i + 2 < faced.indices.size(); i += 3) {
        Triangle t;
        for (std::size_t k = 0; k < 3; ++k) t.corners[k] = source(faced.indices[i + k]);
        // A triangle without area shadows nothing; its neighbours are joined without it.
        if (t.corners[0] == t.corners[1] || t.corners[1] == t.corners[2] || t.corners[2] == t.corners[0]) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t.corners[k], b = t.corners[(k + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), std::uint32_t(triangles.size()), std::uint8_t(k), a < b});
        }
        triangles.push_back(t);
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tuple(a.lo, a.hi, a.triangle, a.k) < std::tuple(b.lo, b.hi, b.triangle, b.k);
    });
    Sets sets(triangles.size());
    std::vector<std::uint32_t> torn;  // one triangle of each edge that does not join exactly two
    for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
        const auto edge = std::uint32_t(edges++);
        for (end = first; end < sides.size() && sides[end].lo == sides[first].lo && sides[end].hi == sides[first].hi;
             ++end) {
            triangles[sides[end].triangle].edges[sides[end].k] = edge;
            sets.join(sides[first].triangle, sides[end].triangle);
        }
        if (end - first != 2 || sides[first].upwards == sides[first + 1].upwards) torn.push_back(sides[first].triangle);
    }
    std::vector<std::uint32_t> number(triangles.size(), ~0u);
    std::vector<double> volume;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        std::uint32_t& n = number[sets.of(i)];
        if (n == ~0u) {
            n = std::uint32_t(parts.size());
            parts.push_back({.closed = true});
            volume.push_back(0);
        }
        triangles[i].part = n;
        // A reference point near the mesh loses little precision.
        const glm::dvec3 from(positions[triangles[0].corners[0]]);
        const auto at = [&](std::size_t k) { return glm::dvec3(positions[triangles[i].corners[k]]) - from; };
        volume[n] += glm::dot(at(0), glm::cross(at(1), at(2)));
    }
    for (const std::uint32_t t : torn) parts[triangles[t].part].closed = false;
    for (std::size_t p = 0; p < parts.size(); ++p) parts[p].inside_out = parts[p].closed && volume[p] < 0;
    for (const Triangle& t : triangles) open_triangles += !parts[t.part].closed;
}

void add_shadow_volume(const VolumeMesh& mesh, const glm::dmat4& world, const VolumeLight& light, bool ends_apart,
                       VolumeTriangles& out) {
    std::vector<glm::dvec3> at(mesh.positions.size());
    for (std::size_t i = 0; i < at.size(); ++i)
        at[i] = glm::dvec3(world * glm::dvec4(glm::dvec3(mesh.positions[i]), 1));
    const bool mirrored = glm::determinant(glm::dmat3(world)) < 0;
    struct Net {
        int times = 0;  ///< uses from the lower corner to the higher, minus uses in the other direction
        std::uint32_t lo = 0, hi = 0;
    };
    std::vector<Net> nets(mesh.edges);
    for (const VolumeMesh::Triangle& t : mesh.triangles) {
        const auto [a, b, c] = t.corners;
        const glm::dvec3 normal = glm::cross(at[b] - at[a], at[c] - at[a]);
        const double rises = glm::dot(normal, light.parallel ? light.to_light : light.position_ws - at[a]);
        const VolumeMesh::Part& part = mesh.parts[t.part];
        const bool faces = rises > 0;
        if (part.closed ? faces == (part.inside_out != mirrored) : rises == 0) continue;
        const auto near = [](std::uint32_t v) { return 2 * v; };
        std::vector<std::uint32_t>& caps = faces ? out.caps : out.clockwise_caps;
        caps.insert(caps.end(), {near(a), near(b), near(c)});
        if (ends_apart) {
            const std::array<std::uint32_t, 3> dark = faces ? std::array{a, c, b} : std::array{a, b, c};
            for (const std::uint32_t v : dark) out.rest.push_back(2 * v + 1);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = t.corners[k], to = t.corners[(k + 1) % 3];
            Net& net = nets[t.edges[k]];
            net.lo = std::min(from, to);
            net.hi = std::max(from, to);
            net.times += (from < to) == faces ? 1 : -1;
        }
    }
    for (const Net& net : nets) {
        const bool upwards = net.times > 0;
        const std::uint32_t from = 2 * (upwards ? net.lo : net.hi), to = 2 * (upwards ? net.hi : net.lo);
        for (int i = 0; i < std::abs(net.times); ++i) {
            out.rest.insert(out.rest.end(), {to, from, from + 1});
            if (ends_apart) out.rest.insert(out.rest.end(), {to, from + 1, to + 1});
        }
    }
}

double covered_pixels(const std::array<glm::dvec4, 3>& clip, int width, int height) {
    std::vector<glm::dvec4> polygon(clip.begin(), clip.end()), next;
    // Sutherland and Hodgman, Reentrant Polygon Clipping, CACM 17(1), 1974.
    for (const glm::dvec4& plane : {glm::dvec4(1, 0, 0, 1), glm::dvec4(-1, 0, 0, 1), glm::dvec4(0, 1, 0, 1),
                                    glm::dvec4(0, -1, 0, 1), glm::dvec4(0, 0, 0, 1)}) {
        next.clear();
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const glm::dvec4 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
            const double da = glm::dot(a, plane), db = glm::dot(b, plane);
            if (da >= 0) next.push_back(a);
            if ((da >= 0) != (db >= 0)) next.push_back(a + (b - a) * (da / (da - db)));
        }
        polygon.swap(next);
    }
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec4 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if (!(a.w > 0) || !(b.w > 0)) return 0;
        twice += (a.x * b.y - b.x * a.y) / (a.w * b.w);
    }
    return std::abs(twice) / 2 * width * height / 4;
}

}  // namespace si
