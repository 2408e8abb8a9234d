// Meshes that cannot shade themselves: flat ones, as a ground or a wall may be, and convex ones.
#pragma once

#include <optional>

#include "renderer/scene/scene.h"
#include "renderer/view/bounds/half_space.h"

namespace si {

/// How far from a plane a body of this radius still counts as lying in it; a floor of a kilometre: a millimetre.
constexpr double flat_tolerance(double radius) {
    return 1e-6 * radius;
}

/// The plane of a mesh whose vertices all lie in it, within flat_tolerance() of its radius and what single precision
/// resolves at its coordinates, as long as that is less than 1/10,000 of the radius.
std::optional<HalfSpace> mesh_plane(const Mesh& mesh);

/// Whether no front face of a mesh can lie in its own shadow: every triangle has all vertices behind it. Meshes of many
/// triangles count as not convex, unless they are flat.
bool is_convex(const Mesh& mesh);

/// A plane under an affine map. Nothing where the map leaves no plane of it.
std::optional<HalfSpace> transformed(const HalfSpace& plane, const glm::dmat4& world);

}  // namespace si
