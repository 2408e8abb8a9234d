#include "renderer/scene/extreme_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace si {
namespace {

constexpr std::size_t kAxes = 32;  ///< each gives two directions

/// Returns the coordinate axes, which find the bounds, and further axes between them.
std::array<glm::dvec3, kAxes> spread_axes() {
    std::array<glm::dvec3, kAxes> axes{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};
    constexpr std::size_t kOthers = kAxes - 3;
    for (std::size_t i = 0; i < kOthers; ++i) {  // a spiral of golden angles over half a sphere
        const double y = (double(i) + 0.5) / kOthers, r = std::sqrt(1 - y * y);
        const double turn = (double(i) + 0.5) * std::numbers::pi * (3 - std::sqrt(5.0));
        axes[3 + i] = {r * std::cos(turn), y, r * std::sin(turn)};
    }
    return axes;
}

/// Returns the positions of the vertices that triangles use.
std::vector<glm::dvec3> used_positions(const Mesh& mesh) {
    std::vector<bool> used(mesh.positions.size());
    for (const std::uint32_t i : mesh.indices) used[i] = true;
    std::vector<glm::dvec3> out;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i]) out.emplace_back(mesh.positions[i]);
    return out;
}

struct Part {
    const Mesh* mesh = nullptr;
    glm::dmat4 world{1.0};  ///< before Scene::placement
};

class Outermost {
public:
    explicit Outermost(const Bounds& bounds) : axes_(spread_axes()) {
        const glm::dvec3 size = glm::max(bounds.hi - bounds.lo, 1e-9 * bounds.radius());
        for (glm::dvec3& axis : axes_) axis /= size;
        far_.fill(-std::numeric_limits<double>::infinity());
    }

    /// Returns the extent of a part's box along an axis in both directions: an upper bound for its vertices.
    std::array<double, 2> reach(const Part& part, std::size_t axis) const {
        const Bounds& b = part.mesh->bounds;
        const glm::dvec3 along = glm::transpose(glm::dmat3(part.world)) * axes_[axis], half = 0.5 * (b.hi - b.lo);
        const double middle = glm::dot(axes_[axis], glm::dvec3(part.world[3])) + glm::dot(along, b.centre());
        const double aside = glm::dot(glm::abs(along), half);
        return {middle + aside, aside - middle};
    }
    bool may_hold(const Part& part) const {
        for (std::size_t i = 0; i < kAxes; ++i)
            if (const auto to = reach(part, i); to[0] > far_[2 * i] || to[1] > far_[2 * i + 1]) return true;
        return false;
    }
    /// Adds the vertices of a part that lie within a box; an empty box holds all.
    void add(const Part& part, const Bounds& within) {
        std::vector<glm::dvec3> positions = used_positions(*part.mesh);
        if (!within.empty())
            std::erase_if(positions, [&](const glm::dvec3& p) {
                const glm::dvec3 at(part.world * glm::dvec4(p, 1));
                return glm::any(glm::lessThan(at, within.lo)) || glm::any(glm::lessThan(within.hi, at));
            });
        for (std::size_t i = 0; i < kAxes; ++i) {
            const glm::dvec3 along = glm::transpose(glm::dmat3(part.world)) * axes_[i];
            const double from = glm::dot(axes_[i], glm::dvec3(part.world[3]));
            for (const glm::dvec3& p : positions) {
                const double to = from + glm::dot(along, p);
                for (const std::size_t way : {0, 1})
                    if (const double far = way ? -to : to; far > far_[2 * i + way]) {
                        far_[2 * i + way] = far;
                        points_[2 * i + way] = glm::dvec3(part.world * glm::dvec4(p, 1));
                    }
            }
        }
    }
    std::vector<glm::dvec3> points() const {
        std::vector<glm::dvec3> out;
        for (std::size_t i = 0; i < far_.size(); ++i)
            if (std::isfinite(far_[i]) && std::ranges::find(out, points_[i]) == out.end()) out.push_back(points_[i]);
        return out;
    }

private:
    std::array<glm::dvec3, kAxes> axes_;  ///< for the scene scaled to a cube
    std::array<double, 2 * kAxes> far_{};
    std::array<glm::dvec3, 2 * kAxes> points_{};
};

}  // namespace

namespace {

/// Returns the outermost points of a scene's objects that lie within a box; an empty box holds all.
std::vector<glm::dvec3> extreme_points(const Scene& scene, const Bounds& within) {
    const glm::dmat4 unplaced = glm::inverse(scene.placement);
    std::vector<Part> parts;
    Bounds bounds;
    for (const Object* o : objects_without_floor(scene)) {
        const Mesh& mesh = scene.meshes[std::size_t(o->mesh)];
        const Part part{&mesh, unplaced * o->world};
        const Bounds own = mesh.bounds.transformed(part.world);
        if (own.empty() || !std::isfinite(own.radius())) continue;
        if (!within.empty()) {
            const Bounds common{glm::max(own.lo, within.lo), glm::min(own.hi, within.hi)};
            if (common.empty()) continue;
            bounds.add(common);
        } else {
            bounds.add(own);
        }
        parts.push_back(part);
    }
    if (parts.empty()) return {};
    Outermost found(bounds);
    // Parts with the farthest boxes come first: most others are then rejected by their boxes.
    for (std::size_t axis = 0; axis < kAxes; ++axis)
        for (const std::size_t way : {0, 1}) {
            const Part& farthest =
                *std::ranges::max_element(parts, {}, [&](const Part& part) { return found.reach(part, axis)[way]; });
            if (found.may_hold(farthest)) found.add(farthest, within);
        }
    for (const Part& part : parts)
        if (found.may_hold(part)) found.add(part, within);
    return found.points();
}

}  // namespace

std::vector<glm::dvec3> extreme_points(const Scene& scene) {
    if (!scene.main_part.empty()) {
        // Room for rounding. An animation may move everything out of the box.
        const glm::dvec3 room = 1e-6 * (scene.main_part.hi - scene.main_part.lo);
        auto points = extreme_points(scene, {scene.main_part.lo - room, scene.main_part.hi + room});
        if (!points.empty()) return points;
    }
    return extreme_points(scene, {});
}

void store_framing_points(Scene& scene) {
    scene.framed = extreme_points(scene);
    scene.framed_bounds = main_bounds(scene).transformed(glm::inverse(scene.placement));
}

}  // namespace si
