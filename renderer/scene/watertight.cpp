#include "renderer/scene/watertight.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <vector>

#include "renderer/scene/scene.h"

namespace si {
namespace {

/// Limit of triangle pairs of one mesh that are tested for intersection.
constexpr std::size_t kMaxPairs = 20'000'000;

using Triple = std::array<std::uint32_t, 3>;
using Corner3d = std::array<glm::dvec3, 3>;

/// Numbering of distinct triples, counting from 0.
class Numbering {
public:
    explicit Numbering(std::size_t most) : places_(std::bit_ceil(2 * most + 2), kFree) { known_.reserve(most); }
    std::uint32_t of(const Triple& words) {
        std::uint64_t hash = 0;
        for (const std::uint32_t w : words) {
            hash = (hash ^ w) * 0x9e3779b97f4a7c15ull;
            hash ^= hash >> 32;
        }
        for (std::size_t at = hash & (places_.size() - 1);; at = (at + 1) & (places_.size() - 1)) {
            if (places_[at] == kFree) {
                places_[at] = std::uint32_t(known_.size());
                known_.push_back(words);
                return places_[at];
            }
            if (known_[places_[at]] == words) return places_[at];
        }
    }

private:
    static constexpr std::uint32_t kFree = ~0u;
    std::vector<std::uint32_t> places_;
    std::vector<Triple> known_;
};

/// Triangles with welded corners: vertices at one position have one index.
struct Welded {
    std::vector<Triple> triangles;
    std::vector<glm::dvec3> places;
    std::vector<std::uint32_t> place_of, vertex_at;  ///< position index by vertex; first vertex by position
};

Welded weld(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
    Welded out;
    Numbering places(positions.size());
    std::vector<std::uint32_t>& place = out.place_of;
    place.resize(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::vec3 p = positions[i] + 0.f;  // -0 becomes 0
        place[i] = places.of(
            {std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y), std::bit_cast<std::uint32_t>(p.z)});
        if (place[i] < out.places.size()) continue;
        out.places.emplace_back(p);
        out.vertex_at.push_back(std::uint32_t(i));
    }
    out.triangles.reserve(indices.size() / 3);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        out.triangles.push_back({place[indices[i]], place[indices[i + 1]], place[indices[i + 2]]});
    return out;
}

struct Edges {
    bool each_way_once = true;            ///< no edge occurs twice in the same direction
    std::vector<std::uint32_t> unpaired;  ///< end positions of edges that occur in one direction only, sorted
    bool match() const { return each_way_once && unpaired.empty(); }
};

Edges edges_of(const Welded& mesh) {
    Edges out;
    // Edges by their smaller position index, as lists of the other index and the direction.
    std::vector<std::size_t> end_of(mesh.places.size() + 1);
    const auto each_edge = [&](const auto& work) {
        for (const Triple& t : mesh.triangles)
            for (std::size_t k = 0; k < 3; ++k) work(t[k], t[(k + 1) % 3]);
    };
    each_edge([&](std::uint32_t a, std::uint32_t b) { ++end_of[std::min(a, b) + 1]; });
    std::partial_sum(end_of.begin(), end_of.end(), end_of.begin());
    std::vector<std::uint64_t> others(mesh.triangles.size() * 3);
    std::vector<std::size_t> next(end_of.begin(), end_of.end() - 1);
    each_edge([&](std::uint32_t a, std::uint32_t b) {
        others[next[std::min(a, b)]++] = std::uint64_t(std::max(a, b)) << 1 | std::uint64_t(a < b);
    });
    for (std::uint32_t a = 0; a < mesh.places.size(); ++a) {
        const auto first = others.begin() + std::ptrdiff_t(end_of[a]),
                   end = others.begin() + std::ptrdiff_t(end_of[a + 1]);
        std::sort(first, end);
        out.each_way_once &= std::adjacent_find(first, end) == end;
        for (auto i = first; i != end; ++i) {
            if (i + 1 != end && *i >> 1 == i[1] >> 1)
                ++i;
            else
                out.unpaired.insert(out.unpaired.end(), {a, std::uint32_t(*i >> 1)});
        }
    }
    std::sort(out.unpaired.begin(), out.unpaired.end());
    out.unpaired.erase(std::unique(out.unpaired.begin(), out.unpaired.end()), out.unpaired.end());
    return out;
}

/// Welds positions closer than a seam's tolerance, and drops triangles that become degenerate.
void join_seams(Welded& mesh, std::vector<std::uint32_t> open) {
    Bounds around;
    for (const glm::dvec3& p : mesh.places) around.add(p);
    const double seam = kSeamToleranceShare * glm::length(around.hi - around.lo);
    const auto& at = mesh.places;
    std::sort(open.begin(), open.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(at[a].x, a) < std::pair(at[b].x, b); });
    std::vector<std::uint32_t> stands_for(at.size());
    std::iota(stands_for.begin(), stands_for.end(), 0u);
    for (std::size_t i = 0; i < open.size(); ++i) {
        if (stands_for[open[i]] != open[i]) continue;
        for (std::size_t k = i + 1; k < open.size() && at[open[k]].x <= at[open[i]].x + seam; ++k) {
            const glm::dvec3 away = glm::abs(at[open[k]] - at[open[i]]);
            if (std::max(away.y, away.z) <= seam) stands_for[open[k]] = open[i];
        }
    }
    for (std::uint32_t& place : mesh.place_of) place = stands_for[place];
    for (Triple& t : mesh.triangles)
        for (std::uint32_t& corner : t) corner = stands_for[corner];
    std::erase_if(mesh.triangles, [](const Triple& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
}

/// Connected parts of a mesh.
struct Parts {
    std::vector<std::uint32_t> of_triangle;
    std::size_t count = 0;
};

Parts parts_of(const Welded& mesh) {
    std::vector<std::uint32_t> up(mesh.places.size());
    std::iota(up.begin(), up.end(), 0u);
    const auto top = [&](std::uint32_t i) {
        while (up[i] != i) i = up[i] = up[up[i]];
        return i;
    };
    for (const Triple& t : mesh.triangles)
        for (const std::size_t k : {1, 2}) up[top(t[k])] = top(t[0]);
    Parts out;
    out.of_triangle.reserve(mesh.triangles.size());
    constexpr std::uint32_t kNone = ~0u;
    std::vector<std::uint32_t> number(mesh.places.size(), kNone);
    for (const Triple& t : mesh.triangles) {
        std::uint32_t& part = number[top(t[0])];
        if (part == kNone) part = std::uint32_t(out.count++);
        out.of_triangle.push_back(part);
    }
    return out;
}

Corner3d corners_of(const Welded& mesh, std::size_t triangle) {
    const Triple& t = mesh.triangles[triangle];
    return {mesh.places[t[0]], mesh.places[t[1]], mesh.places[t[2]]};
}

/// Measures of one connected part of a mesh.
struct BodyPart {
    glm::dvec3 sum{0};
    Bounds box;
    double six_volumes = 0, triangles = 0;
    bool star = true;  ///< all triangles face away from the mean of the corners
    glm::dvec3 middle() const { return sum / (3 * triangles); }
    double size() const { return glm::length(box.hi - box.lo); }
};

std::vector<BodyPart> measure_parts(const Welded& mesh, const Parts& of) {
    std::vector<BodyPart> parts(of.count);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        BodyPart& p = parts[of.of_triangle[i]];
        for (const glm::dvec3& c : corners_of(mesh, i)) {
            p.sum += c;
            p.box.add(c);
        }
        p.triangles += 1;
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        BodyPart& p = parts[of.of_triangle[i]];
        const auto [a, b, c] = corners_of(mesh, i);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double height = glm::dot(normal, a - p.middle());
        p.six_volumes += height;
        p.star &= height > 1e-6 * glm::length(normal) * p.size();
    }
    return parts;
}

/// Returns true when two triangles at most touch: there is an axis on which they do not overlap.
bool apart(const Corner3d& a, const Corner3d& b) {
    const auto parts = [&](const glm::dvec3& axis) {
        const double length = glm::length(axis);
        if (!(length > 0)) return false;
        glm::dvec2 on_a(1e300, -1e300), on_b = on_a;
        for (const glm::dvec3& p : a)
            on_a = {std::min(on_a.x, glm::dot(axis, p - a[0])), std::max(on_a.y, glm::dot(axis, p - a[0]))};
        for (const glm::dvec3& p : b)
            on_b = {std::min(on_b.x, glm::dot(axis, p - a[0])), std::max(on_b.y, glm::dot(axis, p - a[0]))};
        const double touch = 1e-9 * std::max(on_a.y - on_a.x, on_b.y - on_b.x);
        return on_a.y <= on_b.x + touch || on_b.y <= on_a.x + touch;
    };
    const glm::dvec3 normal_a = glm::cross(a[1] - a[0], a[2] - a[0]), normal_b = glm::cross(b[1] - b[0], b[2] - b[0]);
    if (parts(normal_a) || parts(normal_b)) return true;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 edge_a = a[(i + 1) % 3] - a[i], edge_b = b[(i + 1) % 3] - b[i];
        if (parts(glm::cross(normal_a, edge_a)) || parts(glm::cross(normal_b, edge_b))) return true;
        for (std::size_t k = 0; k < 3; ++k)
            if (parts(glm::cross(edge_a, b[(k + 1) % 3] - b[k]))) return true;
    }
    return false;
}

/// Returns true when triangles of one part intersect, or when there are too many pairs to test. Sweeps along x.
bool self_intersects(const Welded& mesh, const std::vector<std::uint32_t>& part_of,
                     const std::vector<BodyPart>& parts) {
    struct Entry {
        glm::dvec3 lo, hi;
        std::size_t triangle;
    };
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < part_of.size(); ++i) {
        if (parts[part_of[i]].star) continue;
        const auto [a, b, c] = corners_of(mesh, i);
        entries.push_back({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), i});
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.lo.x < b.lo.x; });
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < entries.size(); ++i)
        for (std::size_t k = i + 1; k < entries.size() && entries[k].lo.x <= entries[i].hi.x; ++k) {
            if (++pairs > kMaxPairs) return true;
            const Entry &a = entries[i], &b = entries[k];
            if (a.lo.y > b.hi.y || b.lo.y > a.hi.y || a.lo.z > b.hi.z || b.lo.z > a.hi.z) continue;
            if (part_of[a.triangle] != part_of[b.triangle]) continue;
            if (!apart(corners_of(mesh, a.triangle), corners_of(mesh, b.triangle))) return true;
        }
    return false;
}

}  // namespace

WatertightCheck check_watertight(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
    if (indices.size() < 12) return {};
    Welded mesh = weld(positions, indices);
    Edges edges = edges_of(mesh);
    if (!edges.match()) {
        if (!edges.each_way_once) return {};
        join_seams(mesh, std::move(edges.unpaired));
        if (!edges_of(mesh).match()) return {};
    }
    const Parts numbers = parts_of(mesh);
    const std::vector<BodyPart> parts = measure_parts(mesh, numbers);
    for (const BodyPart& p : parts)
        if (!(p.six_volumes > 1e-9 * p.size() * p.size() * p.size())) return {};
    if (self_intersects(mesh, numbers.of_triangle, parts)) return {};
    WatertightCheck out{.closed = !mesh.triangles.empty(), .joined = {}};
    for (std::uint32_t i = 0; i < positions.size(); ++i)
        if (const std::uint32_t there = mesh.vertex_at[mesh.place_of[i]]; positions[there] != positions[i])
            out.joined.emplace_back(i, there);
    return out;
}

}  // namespace si
