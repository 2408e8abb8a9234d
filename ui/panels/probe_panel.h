// The panel Pixel: facts about the probed pixel.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "renderer/inspect/section_drawing.h"
#include "renderer/settings/settings.h"
#include "ui/scene_view/probe_anchor.h"

namespace si {

struct Probe;
struct PixelDiagnosis;

/// Cross-sections of the probed pixel, one for each of its lights.
using Sections = std::shared_ptr<const std::vector<Section>>;

/// Data that the panel Pixel shows about the probed pixel: shadow test, diagnoses and cross-sections.
struct ProbeFacts {
    const Probe* probe = nullptr;  ///< shadow test of state.probe_pixel; null: not known
    AnchorPlace anchor_place = AnchorPlace::Seen;
    std::span<const PixelDiagnosis> diagnoses;  ///< one a light of the probe, once the reference is there
    Sections sections;                          ///< null: the panel is hidden
    bool tracing_probe = false;                 ///< the diagnoses will follow
    bool verdict_follows = false;  ///< the data belongs to an earlier picture; the next picture is being drawn
};

/// Drawings of the cross-sections, kept until the pixel or their size changes.
struct SectionViews {
    /// Drawing of the cross-section of one light's shadow test, for one size on the screen.
    struct View {
        std::size_t light = 0;
        double width = 0, height = 0, em = 0;
        SectionDrawing drawing;
    };
    Sections of;
    std::vector<View> views;
    int drawn = 0;  ///< number of drawings made so far
};

/// State of the panel Pixel: its drawings, and a fix that waits for the pixel's verdict.
struct ProbePanel {
    SectionViews section_views;
    bool fix_waits = false;      ///< the fix was requested before it was found
    bool lists_numbers = false;  ///< the numbers of the shadow test are unfolded
    /// Probed pixel, scene, picture size and settings for which a fix was searched.
    struct Searched {
        glm::ivec2 pixel{0}, size{0};
        std::uint64_t scene = 0;  ///< Scene::id
        Settings settings;
        bool operator==(const Searched&) const = default;
    };
    std::optional<Searched> searched;
};

}  // namespace si
