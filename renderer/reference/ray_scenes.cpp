#include "renderer/reference/ray_scenes.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace si {

std::shared_ptr<const ReferenceScene> RayScenes::get(const std::shared_ptr<const ReferenceGeometry>& geometry,
                                                     const Workers& workers) {
    std::shared_ptr<Place> place;
    {
        const std::lock_guard lock(mutex_);
        std::erase_if(places_, [](const auto& p) { return p.second.use_count() == 1 && p.second->scene.expired(); });
        std::shared_ptr<Place>& entry = places_[geometry->key];
        if (!entry) entry = std::make_shared<Place>();
        place = entry;
    }
    std::unique_lock building(place->building, std::defer_lock);
    while (!building.try_lock_for(std::chrono::milliseconds(10)))
        if (workers.stop.stop_requested()) throw Cancelled();
    std::shared_ptr<const ReferenceScene> old;  // ends after the lock
    {
        const std::lock_guard lock(mutex_);
        if (auto scene = place->scene.lock()) {
            old = std::exchange(last_, scene);
            return scene;
        }
        old = std::exchange(last_, nullptr);
    }
    old.reset();  // the old hierarchy's memory first
    auto scene = std::make_shared<const ReferenceScene>(geometry, workers);
    const std::lock_guard lock(mutex_);
    place->scene = scene;
    old = std::exchange(last_, scene);
    return scene;
}

std::shared_ptr<const ReferenceScene> RayScenes::find(std::uint64_t key) const {
    const std::lock_guard lock(mutex_);
    const auto place = places_.find(key);
    return place == places_.end() ? nullptr : place->second->scene.lock();
}

std::shared_ptr<const ReferenceGeometry> RayScenes::geometry(const Scene& scene, const Settings& settings) const {
    if (const auto known = find(reference_geometry_key(scene, settings).value())) return known->shared_geometry();
    return std::make_shared<const ReferenceGeometry>(scene, settings);
}

std::size_t RayScenes::size() const {
    const std::lock_guard lock(mutex_);
    return std::size_t(
        std::count_if(places_.begin(), places_.end(), [](const auto& p) { return !p.second->scene.expired(); }));
}

void RayScenes::forget() {
    std::shared_ptr<const ReferenceScene> last;
    const std::lock_guard lock(mutex_);
    last = std::exchange(last_, nullptr);
}

RayScenes& ray_scenes() {
    static RayScenes scenes;
    return scenes;
}

}  // namespace si
