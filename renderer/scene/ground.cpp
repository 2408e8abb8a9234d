#include "renderer/scene/ground.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <numbers>
#include <string>

namespace si {
namespace {

constexpr double kLevel = 0.85;       // least cosine to the vertical of a level surface
constexpr double kGentle = 0.5;       // least cosine to the vertical of a landscape's surface
constexpr double kBottom = 0.15;      // share of the scene's height up to which a level surface is a floor
constexpr double kFloorShare = 0.5;   // least share of the scene's width and depth that a floor covers
constexpr double kFlat = 0.25;        // largest height over width of a landscape
constexpr double kRoofedShare = 0.9;  // share of a level surface below other objects from which it is indoors
constexpr double kShadowLengths = 2;  // radius of the disc, in radii and heights of the scene
constexpr double kBelow = 5e-4;       // depth of the disc below the scene, in radii: flat objects stay above it
constexpr int kSides = 96;

constexpr int kCells = 32;  // a side of the grid on which coverage is counted

/// Grid cells of a scene, seen from above, that triangles cover.
class Cover {
public:
    explicit Cover(const Bounds& bounds)
        : lo_(bounds.lo.x, bounds.lo.z),
          per_m_(double(kCells) / glm::dvec2(bounds.hi.x - bounds.lo.x, bounds.hi.z - bounds.lo.z)) {}

    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        const glm::dvec2 p[3] = {cell(a), cell(b), cell(c)};
        const glm::dvec2 lo = glm::min(glm::min(p[0], p[1]), p[2]), hi = glm::max(glm::max(p[0], p[1]), p[2]);
        const auto first = [](double at) { return int(std::clamp(std::ceil(at - 0.5), 0.0, double(kCells))); };
        for (int y = first(lo.y); y < first(hi.y); ++y)
            for (int x = first(lo.x); x < first(hi.x); ++x)
                if (holds(p, {x + 0.5, y + 0.5})) cells_.set(std::size_t(y * kCells + x));
    }
    double share() const { return double(cells_.count()) / (kCells * kCells); }
    /// Returns the share of these cells that `other` covers too.
    double share_under(const Cover& other) const {
        return double((cells_ & other.cells_).count()) / double(std::max<std::size_t>(cells_.count(), 1));
    }

private:
    glm::dvec2 cell(const glm::dvec3& at) const { return (glm::dvec2(at.x, at.z) - lo_) * per_m_; }
    static bool holds(const glm::dvec2* p, const glm::dvec2& at) {
        int left = 0, right = 0;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec2 along = p[(i + 1) % 3] - p[i], to = at - p[i];
            const double side = along.x * to.y - along.y * to.x;
            left += side >= 0;
            right += side <= 0;
        }
        return left == 3 || right == 3;
    }

    glm::dvec2 lo_, per_m_;
    std::bitset<kCells * kCells> cells_;
};

Mesh make_disc(double radius) {
    Mesh mesh;
    mesh.positions.push_back(glm::vec3(0));
    for (int i = 0; i < kSides; ++i) {
        const double angle = 2 * std::numbers::pi * i / kSides;
        mesh.positions.emplace_back(radius * std::cos(angle), 0, -radius * std::sin(angle));
        for (const int corner : {0, 1 + i, 1 + (i + 1) % kSides}) mesh.indices.push_back(std::uint32_t(corner));
    }
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 1, 0));
    for (const glm::vec3& p : mesh.positions) mesh.bounds.add(glm::dvec3(p));
    return mesh;
}

/// Returns a name that no node has.
std::string free_name(const Scene& scene) {
    std::string name = "Ground";
    while (std::ranges::any_of(scene.nodes, [&](const Node& n) { return n.path == name; })) name += " below";
    return name;
}

}  // namespace

bool has_level_surface(const Scene& scene) {
    const Bounds bounds = main_bounds(scene);
    if (bounds.empty()) return false;
    const glm::dvec3 size = bounds.hi - bounds.lo;
    if (!(size.x > 0 && size.z > 0)) return false;
    const double bottom = bounds.lo.y + kBottom * size.y;
    Cover level(bounds), gentle(bounds), above(bounds);
    for (const Object& object : scene.objects) {
        if (object.ground) continue;
        const Mesh& mesh = scene.meshes[std::size_t(object.mesh)];
        const double winding = glm::determinant(glm::dmat3(object.world)) < 0 ? -1 : 1;
        const bool two_sided = mesh.material >= 0 && scene.materials[std::size_t(mesh.material)].double_sided;
        std::vector<glm::dvec3> at(mesh.positions.size());
        for (std::size_t i = 0; i < at.size(); ++i)
            at[i] = glm::dvec3(object.world * glm::dvec4(glm::dvec3(mesh.positions[i]), 1));
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const glm::dvec3 &a = at[mesh.indices[i]], &b = at[mesh.indices[i + 1]], &c = at[mesh.indices[i + 2]];
            if (std::min({a.y, b.y, c.y}) > bottom) above.add(a, b, c);
            const glm::dvec3 normal = winding * glm::cross(b - a, c - a);
            const double up = two_sided ? std::abs(normal.y) : normal.y, whole = glm::length(normal);
            if (!(up > kGentle * whole)) continue;
            gentle.add(a, b, c);
            if (up > kLevel * whole && std::max({a.y, b.y, c.y}) <= bottom) level.add(a, b, c);
        }
    }
    return (level.share() >= kFloorShare && level.share_under(above) < kRoofedShare) ||
           (size.y <= kFlat * std::max(size.x, size.z) && gentle.share() >= kFloorShare);
}

void add_ground(Scene& scene) {
    if (scene.has_floor || !scene.ground_bounds.empty()) return;
    const Bounds bounds = main_bounds(scene);
    if (!(bounds.radius() > 0) || !std::isfinite(bounds.radius())) return;
    scene.has_floor = has_level_surface(scene);
    if (scene.has_floor) return;
    const glm::dvec3 size = bounds.hi - bounds.lo, centre = bounds.centre();
    const double radius = kShadowLengths * (0.5 * std::hypot(size.x, size.z) + size.y);
    Mesh disc = make_disc(radius);
    disc.name = "Ground";
    disc.material = int(scene.materials.size());
    Material material;
    material.name = "Ground";
    material.base_colour = {0.46f, 0.44f, 0.41f, 1.0f};
    scene.materials.push_back(std::move(material));
    Node node;
    node.name = node.path = free_name(scene);
    // Node transforms are relative to Scene::placement.
    node.local[3] =
        glm::inverse(scene.placement) * glm::dvec4(centre.x, bounds.lo.y - kBelow * bounds.radius(), centre.z, 1);
    for (int axis = 0; axis < 3; ++axis) node.local[axis] /= glm::length(scene.placement[0]);
    scene.nodes.push_back(std::move(node));
    scene.meshes.push_back(std::move(disc));
    Object object;
    object.node = int(scene.nodes.size()) - 1;
    object.mesh = int(scene.meshes.size()) - 1;
    object.ground = true;
    scene.objects.push_back(object);
    refresh(scene);
}

void remove_ground(Scene& scene) {
    if (scene.objects.empty() || !scene.objects.back().ground) return;
    scene.objects.pop_back();
    scene.meshes.pop_back();
    scene.nodes.pop_back();
    scene.materials.pop_back();
    refresh(scene);
}

}  // namespace si
