#include "renderer/reference/ray_scenes.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace si {

std::shared_ptr<const ReferenceScene> RaySceneCache::get(const std::shared_ptr<const ReferenceGeometry>& geometry,
                                                         const Workers& workers) {
    std::shared_ptr<Entry> entry;
    {
        const std::lock_guard lock(mutex_);
        std::erase_if(entries_, [](const auto& p) { return p.second.use_count() == 1 && p.second->scene.expired(); });
        std::shared_ptr<Entry>& known = entries_[geometry->key];
        if (!known) known = std::make_shared<Entry>();
        entry = known;
    }
    std::unique_lock building(entry->building, std::defer_lock);
    while (!building.try_lock_for(std::chrono::milliseconds(10)))
        if (workers.stop.stop_requested()) throw Cancelled();
    std::shared_ptr<const ReferenceScene> old;  // released after the lock
    {
        const std::lock_guard lock(mutex_);
        if (auto scene = entry->scene.lock()) {
            old = std::exchange(last_, scene);
            return scene;
        }
        old = std::exchange(last_, nullptr);
    }
    old.reset();  // frees the old hierarchy before the new one is built
    auto scene = std::make_shared<const ReferenceScene>(geometry, workers);
    const std::lock_guard lock(mutex_);
    entry->scene = scene;
    old = std::exchange(last_, scene);
    return scene;
}

std::shared_ptr<const ReferenceScene> RaySceneCache::find(std::uint64_t key) const {
    const std::lock_guard lock(mutex_);
    const auto entry = entries_.find(key);
    return entry == entries_.end() ? nullptr : entry->second->scene.lock();
}

std::shared_ptr<const ReferenceGeometry> RaySceneCache::geometry(const Scene& scene, const Settings& settings) const {
    if (const auto known = find(reference_geometry_key(scene, settings).value())) return known->shared_geometry();
    return std::make_shared<const ReferenceGeometry>(scene, settings);
}

std::size_t RaySceneCache::size() const {
    const std::lock_guard lock(mutex_);
    return std::size_t(
        std::count_if(entries_.begin(), entries_.end(), [](const auto& p) { return !p.second->scene.expired(); }));
}

void RaySceneCache::clear() {
    std::shared_ptr<const ReferenceScene> last;
    const std::lock_guard lock(mutex_);
    last = std::exchange(last_, nullptr);
}

RaySceneCache& ray_scenes() {
    static RaySceneCache scenes;
    return scenes;
}

}  // namespace si
