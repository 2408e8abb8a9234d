// Unit vectors, and bases about them.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace si {

/// Returns a right-handed orthonormal basis whose third column is the unit vector `n`, without branches on
/// near-parallel axes. Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
glm::dmat3 orthonormal_basis(const glm::dvec3& n);

/// Returns the unit normal of a triangle, on the side from which a, b, c run counter-clockwise; 0 for a triangle
/// without area.
inline glm::dvec3 unit_normal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    const double length = glm::length(cross);
    return length > 0 && std::isfinite(length) ? cross / length : glm::dvec3(0);
}

/// Returns the unit vector of an azimuth (degrees about +y, 0 = +z, 90 = +x) and elevation (degrees above the horizon).
/// The vector is exact at multiples of 90 degrees.
glm::dvec3 direction_from_angles(double azimuth_deg, double elevation_deg);

}  // namespace si
