#include "renderer/scene/main_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace si {
namespace {

constexpr double kFarFactor = 20;            ///< length of a scene over that of its main part from which it is trimmed
constexpr double kLowShare = 0.01;           ///< of the corners, at either end of an axis, outside the main part
constexpr std::size_t kMaxTriangles = 4096;  ///< triangles that are looked at
constexpr std::size_t kMaxObjects = 1u << 16;  ///< objects that are looked at

/// Triangle corner of an object, which stands for several.
struct Corner {
    glm::dvec3 at;
    double count = 0;
    double area = 0;  ///< square metres
};

/// Returns evenly chosen corners of all triangles, at least one triangle of each object. World, as `placement` is
/// still the identity.
std::vector<Corner> chosen_corners(const Scene& scene) {
    const std::size_t step = scene.objects.size() / kMaxObjects + 1;
    const double wanted = double(kMaxTriangles) / double(std::max<std::size_t>(scene.triangle_count(), 1));
    std::vector<Corner> out;
    for (std::size_t i = 0; i < scene.objects.size(); i += step) {
        const Object& object = scene.objects[i];
        const Mesh& mesh = scene.meshes[std::size_t(object.mesh)];
        const std::size_t triangles = mesh.indices.size() / 3;
        if (object.ground || triangles == 0) continue;
        const auto chosen = std::clamp<std::size_t>(std::size_t(wanted * double(triangles)), 1, triangles);
        const double stands_for = double(triangles) / double(chosen);
        for (std::size_t k = 0; k < chosen; ++k) {
            const std::size_t first = 3 * (k * triangles / chosen);
            glm::dvec3 at[3];
            for (std::size_t c = 0; c < 3; ++c)
                at[c] = glm::dvec3(object.world * glm::dvec4(glm::dvec3(mesh.positions[mesh.indices[first + c]]), 1));
            const double area = 0.5 * glm::length(glm::cross(at[1] - at[0], at[2] - at[0]));
            for (const glm::dvec3& p : at) out.push_back({p, stands_for, stands_for * area});
        }
    }
    return out;
}

/// Returns the box between the percentiles of corners along each axis. Sorts the corners.
Bounds percentile_box(std::vector<Corner>& corners, double Corner::*weight, double low, double high) {
    double sum = 0;
    for (const Corner& c : corners) sum += c.*weight;
    Bounds out;
    for (int axis = 0; axis < 3; ++axis) {
        std::ranges::sort(corners, {}, [axis](const Corner& c) { return c.at[axis]; });
        double before = 0;
        bool begun = false;
        for (const Corner& c : corners) {
            before += c.*weight;
            if (!begun && before > low * sum) {
                out.lo[axis] = c.at[axis];
                begun = true;
            }
            if (!(before < high * sum)) {
                out.hi[axis] = c.at[axis];
                break;
            }
        }
    }
    return out;
}

double longest_side(const Bounds& b) {
    const glm::dvec3 size = b.hi - b.lo;
    return b.empty() ? 0 : std::max({size.x, size.y, size.z});
}

bool holds(const Bounds& box, const glm::dvec3& p) {
    return glm::all(glm::lessThanEqual(box.lo, p)) && glm::all(glm::lessThanEqual(p, box.hi));
}

/// Returns the area of the triangles that lie below a height. @param corners of whole triangles, three by three
double area_below(const std::vector<Corner>& corners, double y) {
    double out = 0;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
        if (std::max({corners[i].at.y, corners[i + 1].at.y, corners[i + 2].at.y}) <= y) out += corners[i].area;
    return out;
}

/// Returns the bounds of an object's part within a region.
Bounds part_within(const Scene& scene, const Object& object, const Bounds& region) {
    const Mesh& mesh = scene.meshes[std::size_t(object.mesh)];
    const Bounds whole = mesh.bounds.transformed(object.world);
    const Bounds common{glm::max(whole.lo, region.lo), glm::min(whole.hi, region.hi)};
    if (common.empty()) return {};
    if (common == whole) return common;
    Bounds out;
    for (const std::uint32_t i : mesh.indices)
        if (const glm::dvec3 p(object.world * glm::dvec4(glm::dvec3(mesh.positions[i]), 1)); holds(region, p))
            out.add(p);
    return out.empty() ? common : out;  // a large triangle crosses the region
}

}  // namespace

void set_main_part(Scene& scene) {
    scene.main_part = {};
    if (scene.bounds.empty() || !std::isfinite(scene.bounds.radius())) return;
    std::vector<Corner> corners = chosen_corners(scene);
    for (const auto weight : {&Corner::count, &Corner::area}) {
        const Bounds core = percentile_box(corners, weight, kLowShare, 1 - kLowShare);
        const double side = longest_side(core);
        if (!(side > 0)) continue;
        Bounds region;
        std::swap(region.lo, region.hi);  // everything
        bool trimmed = false;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(scene.bounds.hi[axis] - scene.bounds.lo[axis] > kFarFactor * side)) continue;
            region.lo[axis] = core.lo[axis] - side;
            region.hi[axis] = core.hi[axis] + side;
            trimmed = true;
        }
        if (!trimmed) continue;
        for (const Object& object : scene.objects)
            if (!object.ground) scene.main_part.add(part_within(scene, object, region));
        return;
    }
}

std::string far_objects_text(const Scene& scene) {
    if (scene.main_part.empty()) return "";
    const Bounds main = main_bounds(scene);
    double farthest_m = 0;
    std::size_t count = 0;
    const Object* farthest = nullptr;
    for (const Object* o : all_objects(scene)) {
        if (o->ground) continue;
        const Bounds b = scene.meshes[std::size_t(o->mesh)].bounds.transformed(o->world);
        const glm::dvec3 beyond = glm::max(main.lo - b.lo, b.hi - main.hi);
        const double reach_m = std::max({beyond.x, beyond.y, beyond.z});
        count += reach_m > longest_side(main);
        if (reach_m > farthest_m) {
            farthest_m = reach_m;
            farthest = o;
        }
    }
    if (!farthest) return "";
    return fmt::format("node '{}'{} {} {:.3g} m from the rest", scene.nodes[std::size_t(farthest->node)].path,
                       count > 1 ? fmt::format(" and {} more objects", count - 1) : "",
                       count > 1 ? "reach up to" : "reaches", farthest_m);
}

bool looks_z_up(const Scene& scene) {
    const Bounds main = main_bounds(scene);
    if (main.empty()) return false;
    const glm::dvec3 size = main.hi - main.lo;
    constexpr double kLow = 0.25, kFlat = 0.01, kLowest = 0.05, kPlane = 1e-3, kFloor = 0.5;
    const double height = size.y / std::max(size.x, size.z);
    if (!(height < kLow && height > kFlat) || !(size.z > 0)) return false;  // what is flat is a floor
    std::vector<Corner> corners = chosen_corners(scene);
    const double floor_m2 = area_below(corners, main.lo.y + kPlane * size.y);
    if (floor_m2 > kFloor * size.x * size.z) return false;
    std::erase_if(corners, [&](const Corner& c) { return !holds(main, c.at); });
    const Bounds above = percentile_box(corners, &Corner::count, kLowest, 1);
    return above.lo.z - main.lo.z <= kPlane * size.z;
}

}  // namespace si
