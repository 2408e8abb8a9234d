// Shadow volumes: the boundary of the space in a light's shadow, as triangles. CPU; all decisions in double precision.
//
// A triangle shadows the infinite prism behind it. The boundary of all prisms consists of the triangles themselves
// (light caps), copies of them at infinity (dark caps), and quads from edges whose prisms do not cancel. A point's
// shadow count is the number of triangles between it and the light, so the result does not depend on shared edges.
// Shared edges only save work:
//   - In a closed surface each edge joins two triangles that run along it in opposite directions. Its triangles facing
//     the light cast, and its edges are the silhouette.
//   - In any other surface all triangles cast, each turned to the light (Aldridge and Woods, Robust,
//     Geometry-Independent Shadow Volumes, GRAPHITE 2004).
// Crow, Shadow Algorithms for Computer Graphics, SIGGRAPH 1977; Bergeron, A General Version of Crow's Shadow Volumes,
// IEEE CG&A 6(9), 1986.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"

namespace si {

/// Triangles of a mesh for building shadow volumes: corners at the same position are joined, so that neighbouring
/// triangles share edges.
struct VolumeMesh {
    /// Triangle of a mesh from which shadow volumes are built, with its corners and edges.
    struct Triangle {
        std::array<std::uint32_t, 3> corners{};  ///< indices into `positions`, in the mesh's winding order
        std::array<std::uint32_t, 3> edges{};    ///< index of the edge from each corner to the next
        std::uint32_t part = 0;                  ///< index into `parts`
    };
    /// Connected component of a mesh from which shadow volumes are built: triangles joined by common edges.
    struct Part {
        bool closed = false;      ///< every edge joins two triangles in opposite directions
        bool inside_out = false;  ///< closed, with normals that point inwards
    };
    std::vector<glm::vec3> positions;  ///< distinct positions, mesh space
    std::vector<Triangle> triangles;
    std::vector<Part> parts;
    std::size_t edges = 0;           ///< number of edges
    std::size_t open_triangles = 0;  ///< triangles in parts that are not closed

    /// Prepares a mesh for building shadow volumes: joins corners at the same position, and finds its closed parts.
    explicit VolumeMesh(const Mesh& mesh);
};

/// Light for building shadow volumes, which extend away from it: a direction for parallel light, else a position.
struct VolumeLight {
    bool parallel = true;
    glm::dvec3 to_light{0, 1, 0};  ///< unit vector, for parallel light
    glm::dvec3 position_ws{0};     ///< world, for spot and point lights
};

/// Triangles of shadow volumes, three corner indices each. Index 2v is corner v of the mesh, and 2v + 1 is the copy of
/// this corner moved far away from the light. Light caps (ends near the light) are triangles of the mesh itself. Light
/// caps keep the mesh's winding order. The camera pass draws triangles in the same order, so both passes compute
/// bit-equal depths. Seen from outside the volume, all triangles wind counter-clockwise but those in `clockwise_caps`.
struct VolumeTriangles {
    std::vector<std::uint32_t> caps;            ///< light caps that turn counter-clockwise
    std::vector<std::uint32_t> clockwise_caps;  ///< light caps that turn clockwise
    std::vector<std::uint32_t> rest;            ///< sides and dark caps
    /// Returns the number of shadow volume triangles in all lists.
    std::size_t triangles() const { return (caps.size() + clockwise_caps.size() + rest.size()) / 3; }
};

/// Builds the shadow volume of one object under a light, and appends its triangles to `out`.
/// @param world world_from_mesh of the object
/// @param ends_apart true: the far copies of corners are distinct points, so dark caps (the far ends of the volume) are
/// needed; false for parallel light extruded to infinity, where the copies coincide
/// @param[in,out] out lists of triangles
void add_shadow_volume(const VolumeMesh& mesh, const glm::dmat4& world, const VolumeLight& light, bool ends_apart,
                       VolumeTriangles& out);

/// Returns how many pixels of a picture one triangle covers. Used to predict the cost of shadow volumes.
/// @param clip clip coordinates of the triangle's corners; z is ignored, w may have any sign
/// @param width,height size of the picture in pixels
double covered_pixels(const std::array<glm::dvec4, 3>& clip, int width, int height);

/// Estimates the pixels that a list of triangles covers in a picture, with overlapping triangles counted each. Used to
/// predict the cost of shadow volumes.
/// @param list corner indices, three per triangle, as in VolumeTriangles
/// @param corner a function corner(i) that returns the clip coordinates of the corner with index i
/// @param samples largest number of triangles that are evaluated
template <typename Corner>
double covered_pixels(const std::vector<std::uint32_t>& list, Corner&& corner, int width, int height,
                      std::size_t samples) {
    const std::size_t count = list.size() / 3, taken = count < samples ? count : samples;
    double sum = 0;
    for (std::size_t k = 0; k < taken; ++k) {
        const std::size_t t = k * count / taken;
        sum += covered_pixels({corner(list[3 * t]), corner(list[3 * t + 1]), corner(list[3 * t + 2])}, width, height);
    }
    return taken > 0 ? sum * double(count) / double(taken) : 0;
}

}  // namespace si
