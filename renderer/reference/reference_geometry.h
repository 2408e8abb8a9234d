// Geometry for ray tracing: the triangles of a scene as drawn. Arrays are shared with the scene, so that a trace may
// continue while the scene changes.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "renderer/base/key.h"
#include "renderer/reference/alpha_mask.h"
#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"

namespace si {

/// Mesh for ray tracing: triangles and, for masked materials, an alpha test.
struct ReferenceMesh {
    SharedArray<glm::vec3> positions;  ///< shared with the scene, after deformation
    SharedArray<glm::vec3> normals;    ///< smooth vertex normals, not normalised; may be empty
    SharedArray<std::uint32_t> indices;
    std::unique_ptr<const AlphaMask> mask;  ///< alpha test; null: none, all points are solid
    /// Returns the number of triangles.
    std::size_t triangles() const { return indices.size() / 3; }
};

/// Object of a scene for ray tracing: a mesh with its place in the world.
struct ReferenceObject {
    std::shared_ptr<const ReferenceMesh> mesh;
    glm::dmat4 world{1.0};
    bool casts = true;
    bool ground = false;  ///< Object::ground
    std::string path;     ///< path of the object's node
};

/// Corners of a triangle in world space, in double precision: the object's transform is not rounded.
using TriangleWs = std::array<glm::dvec3, 3>;

/// Unit frame: coordinates in which the scene is centred and about one unit long, scaled by a power of two. In these
/// coordinates single-precision rays are accurate for scenes of any size and distance from the world's origin.
struct UnitFrame {
    glm::dvec3 centre{0};
    double scale = 1;  ///< unit lengths per metre
    /// Converts a world-space position to the unit frame.
    glm::dvec3 to_unit(const glm::dvec3& position_ws) const { return (position_ws - centre) * scale; }
};

/// Triangles of all objects of a scene for ray tracing, independent of later changes of the scene.
struct ReferenceGeometry {
    std::vector<ReferenceObject> objects;
    Bounds bounds;
    glm::dvec3 centre{0};  ///< centre of the scene's main part, world space
    std::uint64_t key = 0;

    /// Collects the triangles of a scene for ray tracing. Vertex arrays are shared with the scene, not copied.
    ReferenceGeometry(const Scene& scene, const Settings& settings);
    /// Returns the number of triangles of all objects that cast shadows. Each instance of a mesh counts.
    std::size_t caster_triangles() const;
    /// Returns the corners of a triangle in world space.
    /// @param object index in Scene::objects
    /// @param primitive index of the triangle within the object
    TriangleWs triangle(std::uint32_t object, std::uint32_t primitive) const;
    /// Returns the smooth normal at a point of a triangle, interpolated from those of its corners. It has unit length
    /// and may point to either side of the triangle. It is 0 where the corners' normals cancel, or where the mesh has
    /// none.
    /// @param object index in Scene::objects
    /// @param primitive index of the triangle within the object
    glm::dvec3 smooth_normal(std::uint32_t object, std::uint32_t primitive, const glm::dvec3& position_ws) const;
    /// Returns the coordinate frame in which rays are traced, so that single precision suffices: centred on the scene's
    /// main part and about one unit long.
    UnitFrame unit_frame() const;
    /// Adds the content of this geometry (triangles, transforms, alpha masks) to a cache key that is equal in every
    /// process.
    void add_content(Key& key) const;
};

/// Returns the cache key of a scene's ReferenceGeometry. It depends on the scene, on which objects cast shadows, and on
/// whether blended ones do.
Key reference_geometry_key(const Scene& scene, const Settings& settings);

/// Shadow settings of one object that, besides its geometry, change the ray-traced reference.
struct ObjectTraits {
    bool receives = true;
    Cull cull = Cull::None;  ///< face culling in the shadow map; the object's own setting overrides the scene's
};
/// Returns for each object, by index in Scene::objects, whether it receives shadows and which of its faces shadow maps
/// leave out. For ray tracing and for diagnosing pixels. ReferenceObject::casts says whether it casts.
std::vector<ObjectTraits> object_traits(const Scene& scene, const Settings& settings);

}  // namespace si
