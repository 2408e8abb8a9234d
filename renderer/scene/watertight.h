// Test for watertight meshes: a ray that enters such a mesh from outside always meets a front face first.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

namespace si {

/// Largest gap at a seam that still counts as closed, as a share of the diagonal of the mesh's bounds. It allows for
/// the float rounding of sines and cosines of a full turn.
inline constexpr double kSeamToleranceShare = 1e-6;

/// Result of the test whether a mesh is watertight, with the pairs of vertices to weld for drawing.
struct WatertightCheck {
    bool closed = false;
    /// Pairs of vertex indices: the first vertex is drawn at the position of the second, which closes seams that
    /// rounding left open. Empty if the mesh is not closed.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> joined;
};

/// Tests whether a mesh is watertight. Each edge, identified by the positions of its ends, must belong to two triangles
/// that run along it in opposite directions. Each connected part must enclose a positive volume and not intersect
/// itself. Different parts may overlap. A mesh that would take too long to test counts as not closed.
/// @param indices a triangle list, counter-clockwise from outside
WatertightCheck check_watertight(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);

}  // namespace si
