// One hierarchy of rays for all who trace the same casters: frames' truth, probed pixels, searches, sweeps.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>

#include "renderer/reference/truth_scene.h"

namespace si {

/// Hierarchies by ReferenceGeometry::key. Those that somebody holds are found; of others the last one is kept. Any
/// thread.
class RayScenes {
public:
    /// The hierarchy of that geometry, built unless it is there. Who asks for one that another thread is building waits
    /// for that. @throws Cancelled; Error as ReferenceScene does
    std::shared_ptr<const ReferenceScene> get(const std::shared_ptr<const ReferenceGeometry>& geometry,
                                              const Workers& workers = {});
    /// Null when nobody has built it, or nobody holds it any more.
    std::shared_ptr<const ReferenceScene> find(std::uint64_t key) const;
    /// The geometry of a hierarchy that is there, else a copy of the scene's triangles.
    std::shared_ptr<const ReferenceGeometry> geometry(const Scene& scene, const Settings& settings) const;
    /// How many there are in memory.
    std::size_t size() const;
    /// Keeps none but those that somebody holds.
    void forget();

private:
    struct Place {
        std::timed_mutex building;
        std::weak_ptr<const ReferenceScene> scene;  ///< under RayScenes::mutex_
    };
    mutable std::mutex mutex_;
    std::map<std::uint64_t, std::shared_ptr<Place>> places_;
    std::shared_ptr<const ReferenceScene> last_;
};

/// The process's own.
RayScenes& ray_scenes();

}  // namespace si
