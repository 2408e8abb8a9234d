#include "renderer/view/cascades.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace si {
namespace {

constexpr double kFlatBox = 1e-12;  // a box whose volume is that share of what its edges span has no inside

/// a + b . p >= 0 is inside.
struct Plane {
    double a = 0;
    glm::dvec3 b{0};
    double at(const glm::dvec3& p) const { return a + glm::dot(b, p); }
};

constexpr std::array<std::array<int, 4>, 6> kFaces{
    {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};

/// Adds the corners of what is inside of all planes of a convex polygon.
/// Sutherland, Hodgman, Reentrant Polygon Clipping, CACM 17(1), 1974.
void clip(std::vector<glm::dvec3> polygon, const std::array<Plane, 6>& planes, std::vector<glm::dvec3>& out) {
    std::vector<glm::dvec3> kept;
    for (const Plane& plane : planes) {
        kept.clear();
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const glm::dvec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
            const double a = plane.at(p), b = plane.at(q);
            if (a >= 0) kept.push_back(p);
            if ((a >= 0) != (b >= 0)) kept.push_back(p + (q - p) * (a / (a - b)));
        }
        polygon.swap(kept);
        if (polygon.empty()) return;
    }
    out.insert(out.end(), polygon.begin(), polygon.end());
}

std::vector<glm::dvec3> face(const Box& box, int i) {
    std::vector<glm::dvec3> polygon;
    for (const int k : kFaces[std::size_t(i)]) polygon.push_back(box[std::size_t(k)]);
    return polygon;
}

/// A slice of a camera's frustum in view space: x right, y up, z the distance along the axis.
struct Slice {
    Box corners;
    std::array<Plane, 6> planes;

    Slice(const Camera& c, double from_m, double to_m) {
        const double half = c.orthographic ? 0.5 * c.height : std::tan(0.5 * c.fov_y_rad);
        const glm::dvec2 wide = half * glm::dvec2(c.aspect, 1);
        for (std::size_t i = 0; i < 8; ++i) {
            const double z = i & 4 ? to_m : from_m, scale = c.orthographic ? 1 : z;
            corners[i] = {(i & 1 ? scale : -scale) * wide.x, (i & 2 ? scale : -scale) * wide.y, z};
        }
        planes = {Plane{-from_m, {0, 0, 1}}, Plane{to_m, {0, 0, -1}}};
        for (int side = 0; side < 4; ++side) {
            const int axis = side / 2;
            Plane& p = planes[std::size_t(2 + side)];
            p.b[axis] = side % 2 ? 1 : -1;
            (c.orthographic ? p.a : p.b.z) = wide[axis];
        }
    }
};

/// The planes of a parallelepiped by its edges from corner 0, scaled so that each is 0 on one side and 1 on the other;
/// nothing when it is flat.
std::optional<std::array<Plane, 6>> planes_of(const Box& box) {
    const glm::dmat3 edges(box[1] - box[0], box[2] - box[0], box[4] - box[0]);
    const double volume = std::abs(glm::determinant(edges));
    if (!(volume > kFlatBox * glm::length(edges[0]) * glm::length(edges[1]) * glm::length(edges[2]))) return {};
    const glm::dmat3 rows = glm::transpose(glm::inverse(edges));
    std::array<Plane, 6> planes;
    for (int i = 0; i < 3; ++i) {
        const double at = glm::dot(rows[i], box[0]);
        planes[std::size_t(2 * i)] = {-at, rows[i]};
        planes[std::size_t(2 * i + 1)] = {1 + at, -rows[i]};
    }
    return planes;
}

/// The same in view space.
std::vector<glm::dvec3> seen_in_view(const Slice& slice, const Box& box) {
    bool inside = true;
    for (const Plane& plane : slice.planes) {
        int kept = 0;
        for (const glm::dvec3& p : box) kept += plane.at(p) >= 0;
        if (kept == 0) return {};
        inside &= kept == 8;
    }
    if (inside) return {box.begin(), box.end()};
    std::vector<glm::dvec3> out;
    for (int i = 0; i < 6; ++i) clip(face(box, i), slice.planes, out);
    if (const auto planes = planes_of(box))
        for (int i = 0; i < 6; ++i) clip(face(slice.corners, i), *planes, out);
    return out;
}

Box in_view(const Camera& camera, const Box& box) {
    Box out;
    for (std::size_t i = 0; i < 8; ++i) {
        const glm::dvec3 v = glm::transpose(camera.axes) * (box[i] - camera.eye);
        out[i] = {v.x, v.y, -v.z};
    }
    return out;
}

}  // namespace

std::vector<double> split_depths(double near, double far, int count, double lambda) {
    std::vector<double> ends;
    for (int i = 1; i < count; ++i) {
        const double share = double(i) / count;
        const double even = near + share * (far - near);
        ends.push_back(lambda > 0 ? lambda * near * std::pow(far / near, share) + (1 - lambda) * even : even);
    }
    ends.push_back(far);
    return ends;
}

std::vector<glm::dvec3> seen_corners(const Camera& camera, double from_m, double to_m, const Box& box) {
    std::vector<glm::dvec3> points = seen_in_view(Slice(camera, from_m, to_m), in_view(camera, box));
    for (glm::dvec3& p : points) p = camera.eye + camera.axes * glm::dvec3(p.x, p.y, -p.z);
    return points;
}

std::optional<DepthSpan> seen_depths(const Camera& camera, const std::vector<Box>& boxes,
                                     const std::vector<bool>& wanted) {
    const Slice all(camera, camera.curve.near, camera.curve.far);
    DepthSpan span{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (!wanted[i]) continue;
        for (const glm::dvec3& p : seen_in_view(all, in_view(camera, boxes[i])))
            span = {std::min(span.from_m, p.z), std::max(span.to_m, p.z)};
    }
    if (!(span.from_m <= span.to_m)) return {};
    return span;
}

}  // namespace si
