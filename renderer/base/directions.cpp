#include "renderer/base/directions.h"

#include <cmath>

#include "renderer/base/angles.h"

namespace si {

glm::dmat3 orthonormal_basis(const glm::dvec3& n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    const double b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

glm::dvec3 direction_from_angles(double azimuth_deg, double elevation_deg) {
    const SineCosine az = sine_cosine(azimuth_deg), el = sine_cosine(elevation_deg);
    return glm::dvec3(el.cosine * az.sine, el.sine, el.cosine * az.cosine) + 0.0;  // no zero has a sign
}

}  // namespace si
