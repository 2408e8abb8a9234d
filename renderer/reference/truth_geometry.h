// What of a scene the ray-traced truth needs: the triangles as drawn, shared with the scene until that moves or is
// replaced, so that a trace may go on.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "renderer/base/key.h"
#include "renderer/reference/alpha_mask.h"
#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"

namespace si {

struct ReferenceMesh {
    SharedArray<glm::vec3> positions;  ///< the scene's own: deformed, without degenerate triangles
    SharedArray<std::uint32_t> indices;
    std::unique_ptr<const AlphaMask> mask;  ///< null: solid
    std::size_t triangles() const { return indices.size() / 3; }
};

struct ReferenceObject {
    std::shared_ptr<const ReferenceMesh> mesh;
    glm::dmat4 world{1.0};
    bool casts = true;
    bool ground = false;  ///< Object::ground
};

/// A corner's place in double: the object's transform is never rounded.
struct TriangleWs {
    glm::dvec3 a{0}, b{0}, c{0};
};

/// A frame in which the scene is centred and about one long, scaled by a power of two: single-precision rays lose
/// nothing in it at any scale and distance from the origin.
struct UnitFrame {
    glm::dvec3 centre{0};
    double scale = 1;  ///< unit lengths per metre
    glm::dvec3 to_unit(const glm::dvec3& position_ws) const { return (position_ws - centre) * scale; }
};

/// All objects of a scene by their number (Scene::objects).
struct ReferenceGeometry {
    std::vector<ReferenceObject> objects;
    Bounds bounds;
    std::uint64_t key = 0;

    ReferenceGeometry(const Scene& scene, const Settings& settings);
    /// Of what casts, instances counted.
    std::size_t caster_triangles() const;
    TriangleWs triangle(std::uint32_t object, std::uint32_t primitive) const;
    UnitFrame unit_frame() const;
    /// Adds all that rays can find of it, the same in any process.
    void add_content(Key& key) const;
};

/// What ReferenceGeometry depends on: scene, the objects that cast, and what blended ones do.
Key reference_geometry_key(const Scene& scene, const Settings& settings);

/// What settings say of each object besides, by its number.
struct ObjectTraits {
    bool receives = true;
    Cull cull = Cull::None;  ///< of its faces in the shadow map, the object's own choice before the scene's
};
std::vector<ObjectTraits> object_traits(const Scene& scene, const Settings& settings);

}  // namespace si
