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

/// Cross-sections of the probed pixel's shadow test (surface and stored depths along the light's ray), one for each
/// light.
using Sections = std::shared_ptr<const std::vector<Section>>;

/// Data that the panel Pixel shows about the probed pixel: shadow test, diagnoses, and cross-sections along the light's
/// ray.
struct ProbeFacts {
    const Probe* probe = nullptr;  ///< shadow test of state.probe_pixel; null: not known
    AnchorPlace anchor_place = AnchorPlace::Seen;
    std::span<const PixelDiagnosis> diagnoses;  ///< one for each light of the probe, once the reference is there
    Sections sections;                          ///< null: the panel is hidden
    bool tracing_probe = false;                 ///< the diagnoses will follow
    bool verdict_follows = false;  ///< the data belongs to an earlier picture; the next picture is being drawn
};

/// Cache of drawn cross-sections of a probed pixel's shadow test (surface and stored depths along the light's ray). It
/// is valid until the pixel or the size on the screen changes.
struct SectionViews {
    /// Cross-section of one light's shadow test along the light's ray, drawn for one size on the screen.
    struct View {
        std::size_t light = 0;
        double width = 0, height = 0, em = 0;
        SectionDrawing drawing;
    };
    Sections of;
    std::vector<View> views;
    int drawn = 0;  ///< number of drawings made so far
};

/// State of the panel Pixel: its cached drawings, its unfolded part, and a requested fix that is still searched for.
struct ProbePanel {
    SectionViews section_views;
    bool fix_waits = false;      ///< the fix was requested before it was found
    bool lists_numbers = false;  ///< the numbers of the shadow test are unfolded
    /// Pixel, scene, picture size and settings for which a fix was searched last, so that the search is not repeated.
    struct Searched {
        glm::ivec2 pixel{0}, size{0};
        std::uint64_t scene = 0;  ///< Scene::id
        Settings settings;
        bool operator==(const Searched&) const = default;
    };
    std::optional<Searched> searched;
};

}  // namespace si
