// Bounding volume hierarchy (Embree) over the casters of a scene, for shadow rays.
#pragma once

#include <memory>
#include <span>

#include "renderer/reference/truth_geometry.h"
#include "renderer/reference/workers.h"

namespace si {

/// Use of instances in a ray-tracing hierarchy. Instances share the triangles of a mesh and take memory once. Flattened
/// objects are traced faster, and are transformed in double before rounding.
enum class Instancing {
    Automatic,  ///< shared when flattening would take more than kMostFlattened triangles
    Never,
    Always,  ///< wherever a mesh is used twice
};

/// Ray-tracing hierarchy over the casters of a scene. It uses the scene's UnitFrame, so that single-precision rays keep
/// their accuracy at any scale and distance from the origin.
class TruthScene {
public:
    static constexpr std::size_t kMostFlattened = 4'000'000;

    /// Builds the hierarchy. @throws Error when memory runs out; Cancelled
    explicit TruthScene(std::shared_ptr<const TruthGeometry> geometry, const Workers& workers = {},
                        Instancing instancing = Instancing::Automatic);
    ~TruthScene();
    TruthScene(const TruthScene&) = delete;
    TruthScene& operator=(const TruthScene&) = delete;

    /// Returns the geometry that the hierarchy was built from.
    const TruthGeometry& geometry() const { return *geometry_; }
    /// Returns shared ownership of the geometry that the hierarchy was built from.
    std::shared_ptr<const TruthGeometry> shared_geometry() const { return geometry_; }
    /// Returns the number of triangles in the ray-tracing hierarchy, instances counted.
    std::size_t triangle_count() const;
    /// Returns the number of objects that are instances in the ray-tracing hierarchy.
    std::size_t instance_count() const;

    struct Impl;
    const Impl& impl() const { return *impl_; }

private:
    std::shared_ptr<const TruthGeometry> geometry_;
    std::unique_ptr<Impl> impl_;
};

}  // namespace si
