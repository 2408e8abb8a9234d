#include "renderer/view/bounds/convex.h"

#include <algorithm>
#include <utility>

namespace si {
namespace {

/// Corner indices of the six sides of a box, each in order around its side.
constexpr int kSides[6][4] = {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}};

double extent_m(const Box& body) {
    double size = 0;
    for (const glm::dvec3& p : body) size = std::max(size, glm::distance(p, body[0]));
    return size;
}

void add_sides_within(std::vector<glm::dvec3>& points, const Box& body, std::span<const HalfSpace> planes) {
    Polygon side;
    for (const auto& corners : kSides) {
        side.clear();
        for (const int i : corners) side.push_back(body[std::size_t(i)]);
        for (const HalfSpace& plane : planes) clip_polygon(side, plane);
        points.insert(points.end(), side.begin(), side.end());
    }
}

double cross(const glm::dvec2& o, const glm::dvec2& a, const glm::dvec2& b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

}  // namespace

std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
    std::ranges::sort(points, [](const auto& a, const auto& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    std::vector<glm::dvec2> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t begin = hull.size();
        for (const glm::dvec2& p : points) {
            while (hull.size() >= begin + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
            hull.push_back(p);
        }
        if (!hull.empty()) hull.pop_back();
        std::ranges::reverse(points);
    }
    return hull;
}

double polygon_area(std::span<const glm::dvec2> polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        twice += cross(glm::dvec2(0), polygon[i], polygon[(i + 1) % polygon.size()]);
    return 0.5 * twice;
}

BoxPlacement classify_box(const Box& body, std::span<const HalfSpace> planes) {
    bool within = true;
    for (const HalfSpace& plane : planes) {
        const auto held = std::ranges::count_if(body, [&](const glm::dvec3& p) { return plane.distance(p) >= 0; });
        if (held == 0) return BoxPlacement::Outside;
        within &= held == std::ssize(body);
    }
    return within ? BoxPlacement::Inside : BoxPlacement::Crossing;
}

void clip_polygon(Polygon& polygon, const HalfSpace& plane) {
    if (polygon.empty()) return;
    if (std::ranges::all_of(polygon, [&](const glm::dvec3& p) { return plane.distance(p) >= 0; })) return;
    Polygon left;
    left.reserve(polygon.size() + 1);
    glm::dvec3 before = polygon.back();
    double d_before = plane.distance(before);
    for (const glm::dvec3& p : polygon) {
        const double d = plane.distance(p);
        if ((d < 0) != (d_before < 0)) left.push_back(before + (p - before) * (d_before / (d_before - d)));
        if (d >= 0) left.push_back(p);
        before = p;
        d_before = d;
    }
    polygon = std::move(left);
}

std::vector<HalfSpace> box_half_spaces(const Box& body) {
    glm::dvec3 centre(0);
    for (const glm::dvec3& p : body) centre += p / 8.0;
    const double size = extent_m(body);
    std::vector<HalfSpace> planes;
    for (const auto& side : kSides) {
        // Diagonals span the side, since an edge may have no length (the tip of a pyramid).
        const glm::dvec3 a = body[std::size_t(side[2])] - body[std::size_t(side[0])];
        const glm::dvec3 b = body[std::size_t(side[3])] - body[std::size_t(side[1])];
        const glm::dvec3 normal = glm::cross(a, b);
        const double area = glm::length(normal);
        if (!(area > 1e-12 * size * size)) continue;
        glm::dvec3 middle(0);
        for (const int i : side) middle += 0.25 * body[std::size_t(i)];
        const HalfSpace plane = HalfSpace::through(middle, normal / area);
        planes.push_back(plane.distance(centre) < 0 ? HalfSpace{-plane.normal, -plane.offset} : plane);
    }
    return planes;
}

std::vector<glm::dvec3> points_inside_planes(const Box& body, std::span<const HalfSpace> planes) {
    std::vector<glm::dvec3> points;
    const BoxPlacement where = classify_box(body, planes);
    if (where == BoxPlacement::Inside) points.assign(body.begin(), body.end());
    if (where == BoxPlacement::Crossing) add_sides_within(points, body, planes);
    return points;
}

std::vector<glm::dvec3> intersection_points(const Box& box, std::span<const ConvexBody> bodies) {
    bool within = true;
    for (const ConvexBody& body : bodies) {
        const BoxPlacement where = classify_box(box, body.sides);
        if (where == BoxPlacement::Outside) return {};
        within &= where == BoxPlacement::Inside;
    }
    if (within) return {box.begin(), box.end()};
    std::vector<HalfSpace> planes;
    for (const ConvexBody& body : bodies) planes.insert(planes.end(), body.sides.begin(), body.sides.end());
    std::vector<glm::dvec3> points;
    add_sides_within(points, box, planes);
    // A flat box contains no corner of another body; its clipped sides are the whole intersection.
    const std::vector<HalfSpace> sides_of_box = box_half_spaces(box);
    if (sides_of_box.size() < 6) return points;
    for (const ConvexBody& body : bodies) {
        planes = sides_of_box;
        for (const ConvexBody& other : bodies)
            if (&other != &body) planes.insert(planes.end(), other.sides.begin(), other.sides.end());
        add_sides_within(points, body.corners, planes);
    }
    return points;
}

}  // namespace si
