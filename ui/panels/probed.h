// The probed pixel: what is known of it.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "renderer/inspect/section_drawing.h"
#include "ui/scene_view/probe_anchor.h"

namespace si {

struct Probe;
struct PixelDiagnosis;

/// Cross-sections of the probed pixel, one for each of its lights.
using Sections = std::shared_ptr<const std::vector<Section>>;

struct ProbeShown {
    const Probe* probe = nullptr;  ///< of state.probe_pixel
    AnchorPlace anchor_place = AnchorPlace::Seen;
    std::span<const PixelDiagnosis> diagnoses;  ///< one for each light of the probe, once the truth is there
    Sections sections;                          ///< null: the panel is hidden
    bool tracing_probe = false;                 ///< dossiers will follow
    bool verdict_follows = false;               ///< all of this is of an earlier picture: the next one is being drawn
};

/// Their drawings, kept until the pixel or the room for them changes.
struct SectionViews {
    struct View {
        std::size_t light = 0;
        double width = 0, height = 0, em = 0;
        SectionDrawing drawing;
    };
    Sections of;
    std::vector<View> views;
    int drawn = 0;  ///< how often one was made
};

}  // namespace si
