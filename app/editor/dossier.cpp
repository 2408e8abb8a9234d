#include "app/editor/dossier.h"

#include <chrono>

namespace si {

EditorDossier::~EditorDossier() {
    stop();
}

void EditorDossier::stop() {
    stop_.request_stop();
    if (building_.valid()) building_.wait();
    building_ = {};
}

bool EditorDossier::ready() const {
    return building_.valid() && building_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

void EditorDossier::wait() const {
    if (building_.valid()) building_.wait();
}

void EditorDossier::build(const Scene& scene, const Settings& settings) {
    stop();
    casters_.reset();  // its memory first
    stop_ = {};
    auto geometry = std::make_shared<const TruthGeometry>(scene, settings);
    building_key_ = geometry->key;
    building_ = std::async(std::launch::async, [geometry, token = stop_.get_token()] {
        return std::make_shared<const TruthScene>(geometry, Workers{.stop = token});
    });
}

bool EditorDossier::update(const Probe* probe, bool fresh, const Scene& scene, const Settings& settings,
                           const DriverInfo& driver) {
    if (!probe || !probe->hit) {
        const bool had = !dossiers_.empty();
        dossiers_.clear();
        return had;
    }
    const std::uint64_t key = truth_geometry_key(scene, settings).value();
    if (ready() && building_key_ == key) casters_ = building_.get(), fresh = true;
    if (!fresh) return false;
    dossiers_.clear();
    if (!casters_ || casters_->geometry().key != key) {
        if (!building_.valid() || building_key_ != key) build(scene, settings);
        return true;
    }
    const auto traits = object_traits(scene, settings);
    for (const Probe::PerLight& light : probe->lights)
        dossiers_.push_back(
            explain(*probe, light, fragment_truth(*casters_, *probe, light, settings, traits), settings, driver));
    return true;
}

}  // namespace si
