#include "renderer/view/cascades/cascades.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace si {
namespace {

/// Returns the tangent of the angle between the axis and the ray through the picture's corner.
double corner_tangent(const Camera& camera) {
    return std::tan(0.5 * camera.fov_y_rad) * std::hypot(1.0, camera.aspect);
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

CameraSlice::CameraSlice(const Camera& camera, double from_m, double to_m) : eye_(camera.eye), axes_(camera.axes) {
    const double half = camera.orthographic ? 0.5 * camera.height : std::tan(0.5 * camera.fov_y_rad);
    const glm::dvec2 wide = half * glm::dvec2(camera.aspect, 1);
    for (std::size_t i = 0; i < 8; ++i) {
        const double z = i & 4 ? to_m : from_m, scale = camera.orthographic ? 1 : z;
        corners_[i] = {(i & 1 ? scale : -scale) * wide.x, (i & 2 ? scale : -scale) * wide.y, z};
    }
    // Planes come from the camera and not from the corners, since a slice may be flat and still contain surfaces.
    planes_[0] = {{0, 0, 1}, -from_m};
    planes_[1] = {{0, 0, -1}, to_m};
    for (int side = 0; side < 4; ++side) {
        const int axis = side / 2;
        HalfSpace& plane = planes_[std::size_t(2 + side)];
        glm::dvec3 inwards(0);
        inwards[axis] = side % 2 ? 1 : -1;
        (camera.orthographic ? plane.offset : inwards.z) = wide[axis];
        plane.normal = glm::normalize(inwards);
    }
}

glm::dvec3 CameraSlice::in_view(const glm::dvec3& p) const {
    const glm::dvec3 v = glm::transpose(axes_) * (p - eye_);
    return {v.x, v.y, -v.z};
}

Box CameraSlice::in_view(const Box& box) const {
    Box out;
    for (std::size_t i = 0; i < 8; ++i) out[i] = in_view(box[i]);
    return out;
}

std::vector<glm::dvec3> CameraSlice::visible_points_in_view_space(const Box& box) const {
    const ConvexBody own{corners_, planes_};
    return intersection_points(in_view(box), {&own, 1});
}

std::vector<glm::dvec3> CameraSlice::visible_points(const Box& box, const Box* within) const {
    std::vector<glm::dvec3> points;
    if (within) {
        const Box body = in_view(*within);
        const std::vector<HalfSpace> sides = box_half_spaces(body);
        const ConvexBody both[] = {{corners_, planes_}, {body, sides}};
        points = intersection_points(in_view(box), both);
    } else {
        points = visible_points_in_view_space(box);
    }
    for (glm::dvec3& p : points) p = in_world(p);
    return points;
}

std::vector<glm::dvec3> CameraSlice::visible_points(const SceneShape& shape, std::size_t box) const {
    if (box != shape.ground || shape.ground_shadow.empty()) return visible_points(shape.boxes[box]);
    Polygon part = shape.ground_shadow;
    for (glm::dvec3& p : part) p = in_view(p);
    for (const HalfSpace& plane : planes_) clip_polygon(part, plane);
    for (glm::dvec3& p : part) p = in_world(p);
    return part;
}

std::optional<DepthSpan> visible_depths(const Camera& camera, const std::vector<Box>& boxes,
                                        const std::vector<bool>& wanted) {
    const CameraSlice all(camera, camera.curve.near, camera.curve.far);
    DepthSpan span{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (!wanted[i]) continue;
        for (const glm::dvec3& p : all.visible_points_in_view_space(boxes[i]))
            span = {std::min(span.from_m, p.z), std::max(span.to_m, p.z)};
    }
    if (!(span.from_m <= span.to_m)) return {};
    return span;
}

DepthSpan rotation_stable_depths(const Camera& camera, const glm::dvec3& centre, double radius) {
    if (camera.orthographic) {
        const double depth = glm::dot(camera.eye - centre, camera.axes[2]);
        const double from = radius * std::floor(depth / radius - 1);
        return {from, from + 3 * radius};
    }
    const double distance = glm::distance(camera.eye, centre);
    if (!(distance > radius)) return {0, 2 * radius};
    const double octave = radius * std::exp2(std::floor(std::log2(distance / radius)));
    // A point off the axis has less depth than distance.
    return {(octave - radius) / std::hypot(1.0, corner_tangent(camera)), 2 * octave + radius};
}

Sphere bounding_sphere(const Camera& camera, const DepthSpan& span) {
    const double near = span.from_m, far = span.to_m;
    double along, radius;
    if (camera.orthographic) {
        along = 0.5 * (near + far);
        radius = 0.5 * std::hypot(far - near, camera.height, camera.height * camera.aspect);
    } else {
        // The centre lies on the axis at equal distance from near and far corners, or in the middle of the far side.
        const double diagonal = corner_tangent(camera);
        along = std::min(0.5 * (near + far) * (1 + diagonal * diagonal), far);
        radius = std::hypot(far - along, far * diagonal);
    }
    return {camera.eye - along * camera.axes[2], radius};
}

}  // namespace si
