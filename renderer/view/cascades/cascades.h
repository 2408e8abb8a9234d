// What the camera sees of boxes, and how its depth is divided among several maps. Pure CPU, double precision.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "renderer/projection/camera.h"
#include "renderer/projection/depth_span.h"
#include "renderer/view/bounds/convex.h"
#include "renderer/view/bounds/scene_shape.h"

namespace si {

/// Camera depths at which `count` cascades end, metres; the last one is `far`. The practical split: of the i-th,
/// lambda * near * (far / near)^(i / count) + (1 - lambda) * (near + i / count * (far - near)).
/// Zhang, Sun, Xu, Lun, Parallel-Split Shadow Maps for Large-scale Virtual Environments, VRCIA 2006.
/// @param near, far above 0 where lambda is
std::vector<double> split_depths(double near, double far, int count, double lambda);

/// What a camera sees between two of its depths.
class CameraSlice {
public:
    CameraSlice(const Camera& camera, double from_m, double to_m);
    /// Points whose convex hull is the part of a box that is seen, world space; none when nothing of it is.
    /// @param within only what lies in this body counts
    std::vector<glm::dvec3> visible_points(const Box& box, const Box* within = nullptr) const;
    /// The same of one of the shape's boxes; of the ground the part in shadow.
    std::vector<glm::dvec3> visible_points(const SceneShape& shape, std::size_t box) const;
    /// The same in view space: x right, y up, z the distance along the axis.
    std::vector<glm::dvec3> visible_points_in_view_space(const Box& box) const;
    /// Whether all of a box, or nothing of it, is seen; Across where that is not sure.
    Lies lies(const Box& box) const { return si::lies(in_view(box), planes_); }

private:
    glm::dvec3 in_view(const glm::dvec3& p) const;
    glm::dvec3 in_world(const glm::dvec3& p) const { return eye_ + axes_ * glm::dvec3(p.x, p.y, -p.z); }
    Box in_view(const Box& box) const;

    glm::dvec3 eye_;
    glm::dmat3 axes_;
    Box corners_;                      ///< in view space
    std::array<HalfSpace, 6> planes_;  ///< the same
};

/// The camera depths of what it sees of the boxes that `wanted` names; nothing where it sees none.
std::optional<DepthSpan> visible_depths(const Camera& camera, const std::vector<Box>& boxes,
                                        const std::vector<bool>& wanted);

/// Camera depths that hold all of a sphere that the camera may see, whichever way it looks; they stay as it turns, and
/// change by octaves of its distance. Of an orthographic camera, which sees behind itself, they change with the depth
/// of the sphere's centre, in steps of its radius.
DepthSpan rotation_stable_depths(const Camera& camera, const glm::dvec3& centre, double radius);

struct Sphere {
    glm::dvec3 centre{0};  ///< world
    double radius = 0;
};
/// The smallest sphere around what a camera sees between two depths. Its radius depends on neither place nor direction.
Sphere bounding_sphere(const Camera& camera, const DepthSpan& span);

}  // namespace si
