// Tests for meshes that cannot shadow their own lit side: flat meshes and convex meshes.
#pragma once

#include <optional>

#include "renderer/scene/scene.h"
#include "renderer/view/bounds/half_space.h"

namespace si {

/// Returns the distance in metres from a plane within which a body of a given radius counts as flat: a millionth of the
/// radius.
/// @param radius radius of the body, metres
constexpr double flat_tolerance(double radius) {
    return 1e-6 * radius;
}

/// Returns the plane that contains all vertices of a mesh, in the space of the mesh; empty if the mesh is not flat.
/// Vertices may lie off the plane by flat_tolerance(), or by the single-precision rounding of the coordinates if that
/// is larger. The rounding counts up to 1/10,000 of the mesh's radius.
std::optional<HalfSpace> mesh_plane(const Mesh& mesh);

/// Returns true when a mesh cannot shadow its own front faces: no vertex lies in front of the plane of any triangle.
/// Meshes too large for the test return false.
bool is_convex(const Mesh& mesh);

/// Transforms a plane by an affine matrix to world space. Returns nothing if the transform collapses the plane to a
/// line or point.
/// @param world matrix to world space
std::optional<HalfSpace> transform_plane(const HalfSpace& plane, const glm::dmat4& world);

}  // namespace si
