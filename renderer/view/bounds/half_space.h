// A plane in space and the side of it that counts.
#pragma once

#include <glm/glm.hpp>

namespace si {

/// Points on its positive side have dot(normal, p) + offset > 0.
struct HalfSpace {
    glm::dvec3 normal{0, 1, 0};  ///< unit
    double offset = 0;
    double distance(const glm::dvec3& p) const { return glm::dot(normal, p) + offset; }
    static HalfSpace through(const glm::dvec3& p, const glm::dvec3& unit_normal) {
        return {unit_normal, -glm::dot(unit_normal, p)};
    }
};

}  // namespace si
