// Whether a mesh is the surface of bodies. A line that comes from outside then meets a front face first.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

namespace si {

/// How far apart places along a seam may lie that are meant to be one, as a share of the mesh's size: what sines and
/// cosines of a full turn come to in floats.
inline constexpr double kSeamToleranceShare = 1e-6;

struct WatertightCheck {
    bool closed = false;
    /// Vertices (first) that have to be drawn where another one (second) is: seams that rounding left open. Empty where
    /// the mesh is not closed.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> joined;
};

/// Whether triangles bound bodies: each edge, told by the places of its ends, has two triangles that run along it in
/// opposite directions, and each connected part holds a positive volume and does not pass through itself. Parts may
/// overlap; a hollow in another part is none. Says no where telling would take longer than uploading is worth.
/// @param indices a triangle list, counter-clockwise from outside
WatertightCheck check_watertight(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);

}  // namespace si
