// The boundary of what lies in a light's shadow, as triangles. Pure CPU; all decisions in double.
//
// What a triangle shadows is the prism from it away from the light, without end. The boundary of a sum of such prisms
// is the triangles themselves (light caps), an infinitely far copy of them (dark caps), and quads from those edges
// whose prisms do not cancel. How often a point lies in a prism is how many of the triangles stand between it and the
// light, so that nothing depends on how the triangles are joined; joined ones only cost less:
//   - of a closed surface (each edge has two triangles that run along it in opposite directions) those that face the
//     light do, as each way out of it leads through one of them. Its edges are the silhouette.
//   - of any other all triangles cast, each turned to the light (Aldridge and Woods, Robust, Geometry-Independent
//   Shadow
//     Volumes, GRAPHITE 2004).
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

/// A mesh's triangles, joined where corners share a place.
struct VolumeMesh {
    struct Triangle {
        std::array<std::uint32_t, 3> corners{};  ///< of `positions`, in the order in which the camera draws them
        std::array<std::uint32_t, 3> edges{};    ///< from each corner to the next
        std::uint32_t part = 0;
    };
    /// Triangles that hang together by their edges.
    struct Part {
        bool closed = false;
        bool inside_out = false;  ///< closed, and its normals look inwards
    };
    std::vector<glm::vec3> positions;  ///< no two alike
    std::vector<Triangle> triangles;
    std::vector<Part> parts;
    std::size_t edges = 0;           ///< numbers below which edges are
    std::size_t open_triangles = 0;  ///< of parts that are not closed

    explicit VolumeMesh(const Mesh& mesh);
};

/// Where shadows lie away from.
struct VolumeLight {
    bool parallel = true;
    glm::dvec3 to_light{0, 1, 0};  ///< unit, of parallel light
    glm::dvec3 position_ws{0};     ///< else
};

/// Lists of corners, three a triangle. 2v is corner v of the mesh, 2v + 1 the same far away from the light.
/// Seen from outside of the shadow triangles turn counter-clockwise, but for `clockwise_caps`, which turn the other
/// way: corners of light caps stand in the camera's order, so that both draw the same depth in every bit.
struct VolumeTriangles {
    std::vector<std::uint32_t> caps, clockwise_caps;
    std::vector<std::uint32_t> rest;  ///< sides and dark caps
    std::size_t triangles() const { return (caps.size() + clockwise_caps.size() + rest.size()) / 3; }
};

/// Adds what one object shadows.
/// @param ends_apart whether the far copies of corners lie apart, so that dark caps are needed; not so where they are
/// infinitely far away along parallel light, in a single point
void add_shadow_volume(const VolumeMesh& mesh, const glm::dmat4& world, const VolumeLight& light, bool ends_apart,
                       VolumeTriangles& out);

/// Pixels that the triangles cover in a picture, those behind each other counted each, by a sample of at most
/// `samples`.
/// @param corner clip coordinates of a number in VolumeTriangles
template <typename Corner>
double covered_pixels(const std::vector<std::uint32_t>& list, Corner&& corner, int width, int height,
                      std::size_t samples);

/// Pixels that a triangle covers in a picture. @param clip of its corners; z is left aside, w may be of any sign
double covered_pixels(const std::array<glm::dvec4, 3>& clip, int width, int height);

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
