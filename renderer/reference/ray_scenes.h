// Shared bounding volume hierarchies for ray tracing: references, probed pixels, searches and sweeps over the same
// casters use one hierarchy.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>

#include "renderer/reference/reference_scene.h"

namespace si {

/// Cache of ray-tracing hierarchies by ReferenceGeometry::key, so that references and searches over the same casters
/// share one. Finds hierarchies that are still in use elsewhere, and keeps the last one alive. Usable from any thread.
class RaySceneCache {
public:
    /// Returns the ray-tracing hierarchy of a geometry; builds it on a miss. Waits when another thread is building the
    /// same hierarchy. @throws Cancelled; Error as ReferenceScene does
    std::shared_ptr<const ReferenceScene> get(const std::shared_ptr<const ReferenceGeometry>& geometry,
                                              const Workers& workers = {});
    /// Returns the cached ray-tracing hierarchy with this ReferenceGeometry::key, or null. Never builds one.
    std::shared_ptr<const ReferenceScene> find(std::uint64_t key) const;
    /// Returns the geometry (placed triangles) of a scene for ray tracing: that of a cached hierarchy if there is one,
    /// else a new one from the scene's triangles.
    std::shared_ptr<const ReferenceGeometry> geometry(const Scene& scene, const Settings& settings) const;
    /// Returns the number of this cache's ray-tracing hierarchies that are in memory.
    std::size_t size() const;
    /// Releases the ray-tracing hierarchy that this cache keeps alive. Hierarchies in use elsewhere stay in memory.
    void clear();

private:
    /// Entry of the cache: a ray-tracing hierarchy, and the lock that is held while it is built.
    struct Entry {
        std::timed_mutex building;
        std::weak_ptr<const ReferenceScene> scene;  ///< guarded by RaySceneCache::mutex_
    };
    mutable std::mutex mutex_;
    std::map<std::uint64_t, std::shared_ptr<Entry>> entries_;
    std::shared_ptr<const ReferenceScene> last_;
};

/// Returns the cache of ray-tracing hierarchies of the process.
RaySceneCache& ray_scenes();

}  // namespace si
