// A half-space: a plane and its positive side.
#pragma once

#include <glm/glm.hpp>

namespace si {

/// Half of space on the positive side of a plane: all points p with dot(normal, p) + offset >= 0.
struct HalfSpace {
    glm::dvec3 normal{0, 1, 0};  ///< unit vector towards the positive side
    double offset = 0;           ///< signed distance from the plane to the origin, metres
    /// Returns the signed distance in metres of a point from the half-space's plane; above 0 inside the half-space.
    double distance(const glm::dvec3& p) const { return glm::dot(normal, p) + offset; }
    /// Returns the half-space whose plane contains `p`, with its positive side along `unit_normal`.
    static HalfSpace through(const glm::dvec3& p, const glm::dvec3& unit_normal) {
        return {unit_normal, -glm::dot(unit_normal, p)};
    }
};

}  // namespace si
