#include "app/editor/pixel_diagnosis.h"

namespace si {

bool EditorPixelDiagnosis::update_sections(const Probe* probe, const Settings& settings, bool shown) {
    if (!shown || sections_ || !probe || !probe->hit) return false;
    std::vector<Section> out;
    for (std::size_t i = 0; i < probe->lights.size(); ++i)
        out.push_back(pixel_section(*probe, i, diagnoses_, settings, casters_.get()));
    sections_ = std::make_shared<const std::vector<Section>>(std::move(out));
    return true;
}

bool EditorPixelDiagnosis::update(const Probe* probe, bool fresh, const Scene& scene, const Settings& settings,
                                  const DriverInfo& driver) {
    if (!probe || !probe->hit) {
        building_.drop();
        casters_.reset();
        sections_.reset();
        const bool had = !diagnoses_.empty();
        diagnoses_.clear();
        return had;
    }
    if (auto built = building_.poll()) {
        if (built->problem) std::rethrow_exception(built->problem);
        if (built->value) {
            casters_ = *built->value;
            fresh = true;
        }
    }
    if (!fresh) return false;
    sections_.reset();
    diagnoses_.clear();
    const std::uint64_t key = reference_geometry_key(scene, settings).value();
    if (!casters_ || casters_->geometry().key != key) casters_ = ray_scenes().find(key);
    if (!casters_) {
        if (building_.wanted() && building_key_ == key) return true;
        building_key_ = key;
        building_.start([geometry = ray_scenes().geometry(scene, settings)](const Workers& workers, const auto&) {
            return ray_scenes().get(geometry, workers);
        });
        return true;
    }
    const auto traits = object_traits(scene, settings);
    for (const Probe::PerLight& light : probe->lights)
        diagnoses_.push_back(diagnose_pixel(
            *probe, light, trace_fragment_reference(*casters_, *probe, light, settings, traits), settings, driver));
    return true;
}

}  // namespace si
