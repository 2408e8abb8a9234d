// What the camera sees of boxes, and how its depth is divided among several maps. Pure CPU, double precision.
#pragma once

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

/// The corners of what the camera sees of a box between two depths, world space; empty when it sees nothing of it.
/// The seen part is the convex hull of them.
std::vector<glm::dvec3> seen_corners(const Camera& camera, double from_m, double to_m, const Box& box);

struct DepthSpan {
    double from_m = 0, to_m = 0;
};

/// The camera depths of what it sees of the boxes that `wanted` names; nothing where it sees none.
std::optional<DepthSpan> seen_depths(const Camera& camera, const std::vector<Box>& boxes,
                                     const std::vector<bool>& wanted);

}  // namespace si
