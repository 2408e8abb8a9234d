// Face normals as flat vertex attributes. OpenGL takes a flat attribute from one corner of a triangle, so each triangle
// needs a corner that provides no other normal.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace si {

/// Triangle list in which the last corner of each triangle, OpenGL's default provoking vertex, carries the face normal.
/// A flat vertex attribute then gives each fragment its face normal.
struct FlatNormalMesh {
    std::vector<std::uint32_t> indices;  ///< the mesh's triangles in order, corners rotated but not mirrored
    std::vector<std::uint32_t> copies;   ///< indices of vertices to duplicate at the end of the mesh's vertex arrays
    /// Unit face normal of each vertex, including the copies, in the mesh's space; the winding decides its side. 0
    /// where no triangle reads the normal or the triangle has no area.
    std::vector<glm::vec3> normals;
};

/// Assigns the face normal of each triangle to its last corner, for a flat vertex attribute. Rotates the corners, and
/// copies a vertex where two triangles need different normals at it.
/// @param indices a triangle list
FlatNormalMesh face_normals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);

}  // namespace si
