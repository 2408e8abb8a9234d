// Parts of boxes visible to a camera, and the division of camera depth among cascades. CPU, double precision.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "renderer/projection/camera.h"
#include "renderer/projection/depth_span.h"
#include "renderer/view/bounds/convex.h"
#include "renderer/view/bounds/scene_shape.h"

namespace si {

/// Returns the camera depths in metres at which the cascades of a directional light end; the last one is `far`.
/// Practical split scheme, for the i-th of `count`:
/// lambda * near * (far / near)^(i / count) + (1 - lambda) * (near + i / count * (far - near)).
/// Zhang, Sun, Xu, Lun, Parallel-Split Shadow Maps for Large-scale Virtual Environments, VRCIA 2006.
/// @param near,far camera depths in metres; above 0 where lambda is above 0
/// @param lambda 0 uniform to 1 logarithmic
std::vector<double> split_depths(double near, double far, int count, double lambda);

/// Part of a camera's view frustum between two camera depths. Clips boxes to this part, for example to fit a cascade.
class CameraSlice {
public:
    /// Makes the slice of a camera's view frustum between two depths, metres along the viewing direction.
    CameraSlice(const Camera& camera, double from_m, double to_m);
    /// Returns world-space points whose convex hull is the part of a world-space box inside this slice of the view
    /// frustum; none if the box is outside.
    /// @param within null, or eight corners of a second convex body in the order of Box corners; only the part inside
    /// it counts
    std::vector<glm::dvec3> visible_points(const Box& box, const Box* within = nullptr) const;
    /// Returns world-space points whose convex hull is the part of one object's box inside this slice of the view
    /// frustum; none if the box is outside. Of the ground under a model, only the shadowed part counts.
    /// @param box index into SceneShape::boxes
    std::vector<glm::dvec3> visible_points(const SceneShape& shape, std::size_t box) const;
    /// Returns points whose convex hull is the part of a world-space box inside this slice of the view frustum; none if
    /// the box is outside. The points are in the camera's space: x right, y up, z depth along the viewing direction,
    /// metres.
    std::vector<glm::dvec3> visible_points_in_view_space(const Box& box) const;
    /// Returns whether a world-space box lies inside or outside this slice of the view frustum; Crossing where neither
    /// is certain.
    BoxPlacement classify_box(const Box& box) const { return si::classify_box(in_view(box), planes_); }

private:
    /// Converts a world-space point to the camera's space: x right, y up, z depth along the viewing direction.
    glm::dvec3 in_view(const glm::dvec3& p) const;
    /// Converts a point from the camera's space to world space.
    glm::dvec3 in_world(const glm::dvec3& p) const { return eye_ + axes_ * glm::dvec3(p.x, p.y, -p.z); }
    /// Converts a world-space box to the camera's space (x right, y up, z depth along the viewing direction), corner by
    /// corner.
    Box in_view(const Box& box) const;

    glm::dvec3 eye_;
    glm::dmat3 axes_;
    Box corners_;                      ///< the camera's space
    std::array<HalfSpace, 6> planes_;  ///< sides in the camera's space, facing inwards
};

/// Returns the range of camera depths, in metres, that the visible parts of boxes take up; empty if none is visible.
/// @param boxes world space
/// @param wanted one flag per box; only boxes with true count
std::optional<DepthSpan> visible_depths(const Camera& camera, const std::vector<Box>& boxes,
                                        const std::vector<bool>& wanted);

/// Returns a range of camera depths, in metres, that contains the visible part of a sphere for every viewing direction.
/// Stabilised cascades fitted to it keep their size as the camera turns. The range changes only where the distance from
/// eye to centre passes the radius times a power of two. For an orthographic camera it changes with the depth of the
/// centre, in steps of the radius.
/// @param centre,radius the sphere, such as the one around the scene: world, metres
DepthSpan rotation_stable_depths(const Camera& camera, const glm::dvec3& centre, double radius);

/// Sphere in world space, such as the one around a cascade.
struct Sphere {
    glm::dvec3 centre{0};  ///< world
    double radius = 0;     ///< metres
};
/// Returns the smallest sphere around a camera's frustum between two depths. Its radius does not depend on the camera's
/// place and direction, as stabilised cascades need.
/// @param span the two depths along the viewing direction
Sphere bounding_sphere(const Camera& camera, const DepthSpan& span);

}  // namespace si
