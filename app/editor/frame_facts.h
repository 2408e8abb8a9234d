// Facts about the frame that the editor shows. Copies are cheap and outlive the next frame.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/map_comparison.h"
#include "renderer/inspect/effects.h"
#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/inspect/probe.h"
#include "renderer/render/renderer.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Numbers read back from the GPU for panels: probed pixel, map depths, overlay values. Each number is present only
/// while a panel shows it.
struct ReadBackFacts {
    std::shared_ptr<const Probe> probe;
    AnchorPlace anchor_place = AnchorPlace::Seen;
    std::shared_ptr<const LoupeFacts> loupe;
    std::vector<PixelDiagnosis> diagnoses;  ///< diagnoses of the probed pixel, one for each light
    Sections sections;                      ///< cross-sections of the probed pixel's shadow tests; null: none
    bool tracing_probe = false;             ///< diagnoses of the probed pixel wait for the ray-tracing hierarchy
    std::shared_ptr<const FloatImage> map_values, map_coordinates, overlay_values;
    std::optional<MapPlots> map_facts;
    std::shared_ptr<const TexelUsage> usage, frozen_usage;
    std::optional<double> exact_utilisation;
    std::vector<LostCaster> lost_casters;
};

/// Data of one drawn frame of the editor, copied from the thread that drew it: result, settings, errors, numbers read
/// back. Panels show these data while the next frame is drawn.
struct FrameFacts {
    std::optional<DriverInfo> driver;  ///< driver that drew the frame; nothing: there is no picture
    FrameResult result;
    Settings settings;  ///< settings of the frame
    FrameRequest request;
    ReadBackFacts readings;
    std::optional<ReferenceFacts> reference;
    Image traced_so_far;  ///< pixels traced so far of the reference under way; alpha 0: not traced yet; empty: none
    std::shared_ptr<const LiveError> earlier_error;  ///< last errors computed for this scene and light; null: none
    std::optional<PictureComparisonFacts> picture_comparison;
    MapComparisonFacts map_comparison;
    std::vector<Effect> effects;                  ///< work of the frame, for the panel Effects; empty unless requested
    std::shared_ptr<const NumericHealth> health;  ///< search for invalid numbers; null: not requested, or not finished
    ArtefactSpots artefacts;                      ///< clusters of wrong pixels found by the last search
    std::string shader_log;
    std::string problem;        ///< why there is no picture; empty: nothing is wrong
    bool driver_reset = false;  ///< the driver has lost the OpenGL context

    /// Writes these facts of a drawn frame into the facts that panels read. Pointers in `f` stay valid as long as
    /// this object is unchanged.
    void fill(EditorFrame& f) const {
        f.driver = driver ? &*driver : nullptr;
        f.result = driver ? &result : nullptr;
        f.traced_so_far = traced_so_far;
        f.drawn = driver ? &settings : nullptr;
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
        f.earlier_error = driver ? earlier_error.get() : nullptr;
        f.compared_map = map_comparison.map.get();
        f.compared_picture = map_comparison.picture;
        f.compared_scale_m = map_comparison.scale_m;
        f.comparison_problem = map_comparison.problem;
        f.picture_comparison = picture_comparison;
        f.effects = effects;
        f.health = health.get();
        f.artefacts = &artefacts;
        f.shader_log = shader_log;
        f.driver_reset = driver_reset;
    }
};

}  // namespace si
