#include "app/editor/panel_effects.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "ui/state/shortcuts.h"

namespace si {
namespace {

using State = const PictureState&;
using Requests = const EditorRequests&;

struct PanelRow {
    std::string_view name;
    bool (*wanted)(State, Requests);
    std::string_view why, why_not;
    std::optional<Command> key = {};  ///< command that shows the panel, named in the reason while the panel is hidden
};

constexpr PanelRow kPanels[] = {
    {"panel: depth histogram", [](State, Requests r) { return r.want_map_facts; },
     "The plots under the map are shown: its depths are read back once a frame and counted.",
     "The plots under the map are hidden."},
    {"panel: map under the mouse", [](State, Requests r) { return r.want_map_values; },
     "The map viewer prints depths: those of the map are read back once a frame.",
     "The mouse is not over the map, and no texel is large enough for its number."},
    {"panel: pixels and their texels", [](State, Requests r) { return r.want_links; },
     "A picture is under the mouse: which texel each pixel reads is read back once a frame.",
     "The mouse is over neither picture, or drags."},
    {"panel: texels read, exactly", [](State, Requests r) { return r.want_exact_texels; },
     "The map viewer marks the texels that kernels fetch.", "The map viewer does not mark the texels that are read."},
    {"panel: values of the overlay",
     [](State s, Requests r) { return r.want_overlay_values && s.settings.view.overlay > 0; },
     "The overlay is under the mouse: its values are read back once a frame.",
     "No overlay is under the mouse, or it drags."},
    {"panel: texels of the frozen camera", [](State s, Requests r) { return s.frozen && r.want_frozen_usage; },
     "A camera is frozen: a frame of its own finds the texels that it reads, until a setting changes.",
     "No camera is frozen."},
    {"panel: probed pixel", [](State s, Requests) { return s.probe_pixel.has_value(); },
     "A pixel is probed: its shadow test is written out once a frame.", "No pixel is probed."},
    {"panel: cross-section", [](State s, Requests) { return s.shows(Page::Pixel) && s.probe_pixel.has_value(); },
     "The panel Pixel is shown: the section along the light's ray is laid out where its numbers change.",
     "The panel Pixel is hidden, or no pixel is probed."},
    {"panel: loupe", [](State s, Requests) { return s.loupe_pixel.has_value(); },
     "The loupe is shown: the pixels under it are read back where they change.", "No loupe is shown",
     Command::NextLoupeMode},
    {"panel: other side of the comparison", [](State s, Requests) { return s.comparison.view != ComparisonView::Off; },
     "The picture is compared with another, which is drawn where it changes.", "Nothing is compared",
     Command::NextComparison},
    {"panel: objects lost to culling", [](State s, Requests) { return s.shows(Page::Objects); },
     "The list of objects is shown.", "The list of objects is hidden."},
    {"panel: errors", [](State, Requests r) { return r.want_error; },
     "The error panel or the overlay artefacts shows numbers.",
     "The error panel is hidden, and the overlay artefacts is not chosen."},
    {"panel: the present settings on the frontier", [](State, Requests r) { return r.want_present; },
     "The frontier panel follows the settings: they are measured in the background.",
     "The frontier panel is hidden, or does not follow the settings."},
    {"panel: soundness of all numbers", [](State, Requests r) { return r.want_health; },
     "The panel Numbers is shown: every map and the visibility are searched once a frame.",
     "The panel Numbers is hidden."},
    {"panel: pass times", [](State, Requests r) { return r.want_timing; }, "This panel shows them: each pass is timed.",
     "No panel shows times."},
};

}  // namespace

std::vector<Effect> panel_effects(const PictureState& state, const EditorRequests& requests) {
    std::vector<Effect> out;
    for (const PanelRow& row : kPanels) {
        const bool wanted = row.wanted(state, requests);
        std::string reason(wanted ? row.why : row.why_not);
        if (!wanted && row.key) reason = with_key(reason, *row.key) + ".";
        out.push_back({.name = std::string(row.name),
                       .state = wanted ? EffectState::Drawn : EffectState::NotNeeded,
                       .reason = std::move(reason)});
    }
    return out;
}

Effect artefact_effect(const ArtefactRequest& request, const ArtefactSpots& found, bool now) {
    Effect effect{.name = "panel: next artefact"};
    if (request.number == 0) {
        effect.reason = "The next artefact is not requested.";
    } else if (request.number != found.number) {
        effect.reason = "It is requested, and waits for the reference of the picture.";
    } else {
        effect.state = now ? EffectState::Drawn : EffectState::Cached;
        effect.reason = fmt::format("{} cluster{} of wrong pixels: searched {}.", found.spots.size(),
                                    found.spots.size() == 1 ? "" : "s",
                                    now ? "once, on request" : "at the last request, and not since");
    }
    return effect;
}

Effect reference_effect(const ReferenceFacts& reference) {
    Effect effect{.name = "rays of the reference"};
    if (!reference.wanted)
        effect.reason = "Neither a panel, an overlay nor a light's source needs rays.";
    else if (!reference.doing.empty()) {
        effect.state = EffectState::Drawn;
        effect.reason = as_sentence(reference.doing + " in the background");
    } else if (reference.current) {
        effect.state = EffectState::Cached;
        effect.reason = "They were traced, and nothing they depend on changed.";
    } else
        effect.reason =
            reference.problem.empty() ? "They wait until the picture stays the same." : as_sentence(reference.problem);
    return effect;
}

}  // namespace si
