// What the camera sees of boxes, and how its depth is divided among several maps. Pure CPU, double precision.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "renderer/view/camera.h"
#include "renderer/view/fit_bounds.h"

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
    std::vector<glm::dvec3> seen_of(const Box& box, const Box* within = nullptr) const;
    /// The same in view space: x right, y up, z the distance along the axis.
    std::vector<glm::dvec3> seen_in_view(const Box& box) const;

private:
    Box in_view(const Box& box) const;

    glm::dvec3 eye_;
    glm::dmat3 axes_;
    Box corners_;                      ///< in view space
    std::array<HalfSpace, 6> planes_;  ///< the same
};

struct DepthSpan {
    double from_m = 0, to_m = 0;
};

/// The camera depths of what it sees of the boxes that `wanted` names; nothing where it sees none.
std::optional<DepthSpan> seen_depths(const Camera& camera, const std::vector<Box>& boxes,
                                     const std::vector<bool>& wanted);

}  // namespace si
