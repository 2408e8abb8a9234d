// What is known of the frame that the editor shows. Copies of it are cheap, and outlive the next frame.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/frame/effects.h"
#include "renderer/frame/renderer.h"
#include "renderer/inspect/dossier.h"
#include "renderer/inspect/probe.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Numbers read back from it, each only while a panel shows it.
struct ReadingFacts {
    std::shared_ptr<const Probe> probe;
    AnchorPlace anchor_place = AnchorPlace::Seen;
    std::shared_ptr<const LoupeFacts> loupe;
    std::vector<PixelDiagnosis> diagnoses;  ///< of the probed pixel
    Sections sections;                      ///< of it, while the panel is shown
    bool tracing_probe = false;             ///< they will follow
    std::shared_ptr<const FloatImage> map_values, map_coordinates, overlay_values;
    std::optional<MapFacts> map_facts;
    std::shared_ptr<const TexelUsage> usage, frozen_usage;
    std::optional<double> exact_utilisation;
    std::vector<LostCaster> lost_casters;
};

struct FrameFacts {
    std::optional<DriverInfo> driver;  ///< nothing: there is no picture
    FrameResult result;
    FrameRequest request;
    ReadingFacts readings;
    std::optional<ReferenceFacts> reference;
    std::optional<AgainstFacts> against;
    std::vector<Effect> effects;                  ///< empty unless asked for
    std::shared_ptr<const NumericHealth> health;  ///< null: not asked for, or not there yet
    ArtefactSpots artefacts;                      ///< as EditorFrame has them
    std::string shader_log;
    std::string problem;        ///< why there is no picture; empty: nothing is wrong
    bool driver_reset = false;  ///< as EditorFrame has it

    /// Tells the editor. The pointers hold as long as this does, unchanged.
    void fill(EditorFrame& frame) const;
};

}  // namespace si
