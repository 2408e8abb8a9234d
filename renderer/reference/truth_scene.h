// The casters of a scene in a bounding volume hierarchy (Embree), to ask what lies between a surface and a light.
#pragma once

#include <memory>
#include <span>

#include "renderer/reference/truth_geometry.h"
#include "renderer/reference/workers.h"

namespace si {

/// Whether objects of one mesh share its triangles in the hierarchy. Flattened they are traced faster and placed in
/// double before they are rounded; shared they take memory once.
enum class Instancing {
    Automatic,  ///< shared when flattening would take more than kMostFlattened triangles
    Never,
    Always,  ///< wherever a mesh is used twice
};

/// Traces in a frame of its own: centred on the scene's bounds and scaled by a power of two to about unit size, both in
/// double, so that single-precision rays lose nothing at any scale and distance from the origin.
class ReferenceScene {
public:
    static constexpr std::size_t kMostFlattened = 4'000'000;

    /// @throws Error when memory runs out; Cancelled
    explicit ReferenceScene(std::shared_ptr<const ReferenceGeometry> geometry, const Workers& workers = {},
                            Instancing instancing = Instancing::Automatic);
    ~ReferenceScene();
    ReferenceScene(const ReferenceScene&) = delete;
    ReferenceScene& operator=(const ReferenceScene&) = delete;

    const ReferenceGeometry& geometry() const { return *geometry_; }
    std::shared_ptr<const ReferenceGeometry> shared_geometry() const { return geometry_; }
    /// What the hierarchy holds, instances counted.
    std::size_t triangle_count() const;
    /// How many objects share a mesh in it.
    std::size_t instance_count() const;

    struct Impl;
    const Impl& impl() const { return *impl_; }

private:
    std::shared_ptr<const ReferenceGeometry> geometry_;
    std::unique_ptr<Impl> impl_;
};

}  // namespace si
