// Hierarchy of casters' triangles for the question which of them may stand between some surface points and a light.
// Internal to this folder.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "renderer/reference/embree.h"

namespace si {

/// Region between some surface points and a light with a size, in the scene's unit frame. It holds every segment from
/// one of the points to a point of the light. Its cross-section is a rectangle that grows with the height above the
/// points. Rounding of coordinates in single precision has to be allowed for.
struct LightShaft {
    glm::mat3 axes{1};          ///< columns: two axes across the shaft, then the axis towards the light; unit vectors
    glm::vec2 low{0}, high{0};  ///< bounds of the points along the two axes across
    float bottom = 0;           ///< least height of the points along the third axis
    float top = 0;              ///< largest height of the light; infinite for directional lights
    glm::vec2 slope{0};         ///< growth of the rectangle at each side, per unit of height
};

/// Triangles of casters in a LightShaft, with the boxes that surround them along the shaft's axes. Arrays by triangle.
struct ShaftTriangles {
    std::vector<std::uint32_t> caster;                ///< index in RayHierarchy::casters
    std::vector<std::uint32_t> primitive;             ///< triangle within the object
    std::vector<float> low_x, low_y, high_x, high_y;  ///< bounds along the two axes across the shaft
    std::vector<float> top;                           ///< largest height along the axis towards the light

    /// Returns the number of triangles.
    std::size_t size() const { return caster.size(); }
    /// Removes all triangles.
    void clear();
};

/// Bounding volume hierarchy over the triangles of all casters of a scene. Embree builds it. Unlike Embree's own
/// hierarchy it can list the triangles that lie in a LightShaft.
class CasterTree {
public:
    /// Builds the hierarchy over the triangles of a scene without instances.
    /// @param scene must outlive this object
    /// @param triangles numbers of triangles, by the id of Embree's geometry
    /// @throws Error for lack of memory; Cancelled
    CasterTree(RTCDevice device, RTCScene scene, std::span<const std::size_t> triangles, const std::stop_token& stop);

    /// Lists the triangles whose boxes meet a shaft. Returns false if there are more than `most`; the list is then
    /// incomplete.
    /// @param out receives the triangles
    bool collect(const LightShaft& shaft, std::size_t most, ShaftTriangles& out) const;
    /// Returns the corners of a triangle in the scene's unit frame, as Embree has them.
    std::array<glm::vec3, 3> corners(std::uint32_t caster, std::uint32_t primitive) const {
        const Buffers& b = buffers_[caster];
        const std::uint32_t* index = b.indices + 3 * std::size_t(primitive);
        return {b.positions[index[0]], b.positions[index[1]], b.positions[index[2]]};
    }

private:
    /// Arrays of one caster's triangles, which Embree holds.
    struct Buffers {
        const glm::vec3* positions = nullptr;
        const std::uint32_t* indices = nullptr;
    };
    /// Node of the hierarchy, defined in the source file. Embree's allocator owns all nodes.
    struct Node;

    std::vector<Buffers> buffers_;  ///< by caster
    std::unique_ptr<std::remove_pointer_t<RTCBVH>, embree::Releaser<rtcReleaseBVH>> nodes_;
    const Node* root_ = nullptr;  ///< null: no triangles
};

}  // namespace si
