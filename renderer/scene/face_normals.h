// A normal for each triangle, carried by vertices: flat shading takes an attribute from one corner of a triangle, so
// each triangle needs a corner that no triangle with another normal takes it from.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace si {

/// A mesh whose triangles' last corners (OpenGL's provoking vertices unless told otherwise) carry their normals.
struct FlatNormalMesh {
    std::vector<std::uint32_t> indices;  ///< the mesh's triangles in order, their corners turned about but not mirrored
    std::vector<std::uint32_t> copies;   ///< the vertices that follow the mesh's own repeat these
    /// By vertex, copies included: unit, by winding, in the mesh's space; 0 where no triangle asks or it has no area.
    std::vector<glm::vec3> normals;
};

/// @param indices a triangle list
FlatNormalMesh face_normals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);

}  // namespace si
