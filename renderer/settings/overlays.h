// The table of overlays: a new one is one row here and one GLSL file.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "renderer/settings/param.h"
#include "renderer/settings/settings.h"

namespace si {

/// How an overlay's values come about: per visible fragment, along the edges of all triangles, or as a count of
/// every fragment whatever its depth.
enum class OverlayDraw { Fragments, Edges, Count };

/// What an overlay is looked at for.
enum class OverlayGroup { Wrong, Bias, Resolution, Depth, Debug };

/// An overlay. Its file defines `vec4 overlay(Receiver r)`; scalars in x, NaN where undefined.
struct Overlay {
    std::string_view key, label, unit, help;
    OverlayGroup group = OverlayGroup::Debug;
    std::string_view file;
    std::string_view paper;         ///< where what it shows comes from; empty: from no one paper
    bool scalar = true;             ///< x goes through the colour scale; otherwise rgba as it is
    double min = 0, max = 1;        ///< colour scale when view.overlay_range is declared
    bool diverging = false;         ///< the scale is centred on zero
    bool reads_visibility = false;  ///< asks for the visibility texture
    bool names_causes = false;      ///< its colours are those of causes; their legend has numbers
    bool names_views = false;       ///< its colours are those of a light's views
    bool reads_reference = false;   ///< asks for the traced truth and for what it makes of the visibility
    bool reads_precision = false;   ///< asks for what double precision says of the look-ups
    bool as_drawn = false;          ///< of look-ups that save what the picture's save
    OverlayDraw draw = OverlayDraw::Fragments;
};

std::span<const Overlay> overlays();
std::span<const Choice> overlay_choices();  ///< "none" first

/// What a pane shows: a row's number + 1, 0 for none.
int& overlay_of_pane(ViewSettings& view, std::size_t pane);
/// That of each pane that there is.
std::vector<int> pane_overlays(const ViewSettings& view);

/// Some pane shows an overlay that has this.
bool any_pane_shows(const ViewSettings& view, bool Overlay::*what);

}  // namespace si
