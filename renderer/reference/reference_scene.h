// Bounding volume hierarchy (Embree) over the casters of a scene, for shadow rays.
#pragma once

#include <memory>
#include <span>

#include "renderer/base/workers.h"
#include "renderer/reference/reference_geometry.h"

namespace si {

/// Ray-tracing hierarchy in Embree, defined in renderer/reference/reference_rays.h.
struct RayHierarchy;

/// Choice whether objects of one mesh share its triangles in the ray-tracing hierarchy. Shared triangles (instances)
/// take memory once. Flattened copies are traced faster and transformed in double precision.
enum class Instancing {
    Automatic,  ///< shares when flattening would exceed kMaxFlattenedTriangles
    Never,      ///< flattens all objects
    Always,     ///< shares every mesh with several objects
};

/// Ray-tracing hierarchy over the casters of a scene. Its coordinates are centred on the scene and scaled to about one
/// unit (UnitFrame). Single-precision rays therefore keep their accuracy at any scale and distance from the origin.
class ReferenceScene {
public:
    static constexpr std::size_t kMaxFlattenedTriangles = 4'000'000;

    /// Builds the ray-tracing hierarchy over the casters of a geometry. @throws Error when Embree fails, such as for
    /// lack of memory; Cancelled
    explicit ReferenceScene(std::shared_ptr<const ReferenceGeometry> geometry, const Workers& workers = {},
                            Instancing instancing = Instancing::Automatic);
    ~ReferenceScene();
    ReferenceScene(const ReferenceScene&) = delete;
    ReferenceScene& operator=(const ReferenceScene&) = delete;

    /// Returns the geometry that the hierarchy was built from.
    const ReferenceGeometry& geometry() const { return *geometry_; }
    /// Returns shared ownership of the geometry that the hierarchy was built from.
    std::shared_ptr<const ReferenceGeometry> shared_geometry() const { return geometry_; }
    /// Returns the number of triangles in the ray-tracing hierarchy. Each instance of a mesh counts.
    std::size_t triangle_count() const;
    /// Returns the number of objects that are instances in the ray-tracing hierarchy: they share the triangles of their
    /// mesh.
    std::size_t instance_count() const;

    /// Returns the Embree hierarchy. Only sources in renderer/reference call it.
    const RayHierarchy& impl() const { return *impl_; }

private:
    std::shared_ptr<const ReferenceGeometry> geometry_;
    std::unique_ptr<RayHierarchy> impl_;
};

}  // namespace si
