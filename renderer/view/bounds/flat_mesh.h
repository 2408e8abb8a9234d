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

/// Returns the plane that contains all vertices of a mesh, in the space of the mesh; empty if the mesh is not flat. The
/// tolerance is flat_tolerance(), or the rounding of single-precision coordinates up to 1/10,000 of the radius.
std::optional<HalfSpace> mesh_plane(const Mesh& mesh);

/// Returns true when no front face of a mesh can lie in the shadow of the mesh: no vertex lies in front of the plane of
/// any triangle. Meshes too large for the test return false.
bool is_convex(const Mesh& mesh);

/// Returns a plane after an affine transform to world space; empty if the transform collapses the plane.
std::optional<HalfSpace> transform_plane(const HalfSpace& plane, const glm::dmat4& world);

}  // namespace si
