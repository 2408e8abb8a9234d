#include "app/editor/frame_facts.h"

namespace si {

void FrameFacts::fill(EditorFrame& f) const {
    f.driver = driver ? &*driver : nullptr;
    f.result = driver ? &result : nullptr;
    f.probe = readings.probe.get();
    f.anchor_place = readings.anchor_place;
    f.loupe = readings.loupe.get();
    f.diagnoses = readings.diagnoses;
    f.sections = readings.sections;
    f.tracing_probe = readings.tracing_probe;
    f.map_values = readings.map_values.get();
    f.map_facts = readings.map_facts ? &*readings.map_facts : nullptr;
    f.map_coordinates = readings.map_coordinates.get();
    f.texel_usage = readings.usage.get();
    f.exact_utilisation = readings.exact_utilisation;
    f.frozen_usage = readings.frozen_usage.get();
    f.overlay_values = readings.overlay_values.get();
    f.lost_casters = readings.lost_casters;
    f.reference = reference;
    f.error = driver ? result.error.get() : nullptr;
    f.against = against;
    f.effects = effects;
    f.health = health.get();
    f.artefacts = &artefacts;
    f.shader_log = shader_log;
    f.driver_reset = driver_reset;
}

}  // namespace si
