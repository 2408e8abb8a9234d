// Table of overlays. A new overlay is one row of this table and one GLSL file.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/settings/param.h"
#include "renderer/settings/settings.h"

namespace si {

/// Drawing method of an overlay: a value for each visible fragment, the edges of triangles, or a count of fragments.
enum class OverlayDraw {
    Fragments,  ///< one value for each visible fragment
    Edges,      ///< lines along the edges of all triangles
    Count,      ///< number of all fragments at a pixel, hidden ones included
};

/// Topic under which lists show an overlay.
enum class OverlayGroup { Wrong, Bias, Resolution, Depth, Debug };

/// Row of the table of overlays: a quantity of the shadow test drawn over the scene. The GLSL file that a row names
/// defines `vec4 overlay(Receiver r)`; a scalar is in x, NaN if undefined.
struct Overlay {
    std::string_view key, label, unit, help;
    OverlayGroup group = OverlayGroup::Debug;
    std::string_view paper;            ///< source; empty: no single paper
    bool scalar = true;                ///< x goes through the colour scale; else the value is a colour with alpha
    double min = 0, max = 1;           ///< ends of the colour scale if view.overlay_range is declared
    bool diverging = false;            ///< colour scale is centred on zero
    bool reads_visibility = false;     ///< needs the visibility texture
    bool names_causes = false;         ///< colours stand for causes of wrong pixels; the legend has numbers
    bool names_views = false;          ///< colours stand for the views of a light
    bool reads_reference = false;      ///< needs the ray-traced reference and the classification of the pixels
    bool reads_precision = false;      ///< needs the comparison of the look-ups with double precision
    bool reads_flip = false;           ///< needs the difference to the picture with the reference's shadows
    bool keeps_optimisations = false;  ///< its look-ups keep optimisations that other overlays switch off
    OverlayDraw draw = OverlayDraw::Fragments;
    std::size_t first_pane = 0;  ///< pane (1 to 3) that gets this overlay when panes open without any; 0: none
    /// Returns the path of the overlay's GLSL file below shaders/, made from the overlay's key with underscores.
    std::string file() const;
};

/// Returns all rows of the table of overlays, which are quantities drawn over the scene picture.
std::span<const Overlay> overlays();
/// Returns the choices of the setting view.overlay: "none", then one for each row of the overlay table.
std::span<const Choice> overlay_choices();

/// Returns the setting that chooses the overlay of one pane (picture of the split view), for reading and writing. Its
/// value is 0 for no overlay, else the overlay's row in overlays() plus 1.
/// @param pane index of the pane, 0 to 3
int& overlay_of_pane(ViewSettings& view, std::size_t pane);
/// Returns the chosen overlay of each visible pane (picture of the split view), one entry a pane: 0 for no overlay,
/// else the overlay's row in overlays() plus 1.
std::vector<int> pane_overlays(const ViewSettings& view);

/// Returns true when the overlay of any visible pane (picture of the split view) has the property `what`, for example
/// &Overlay::reads_reference.
bool any_pane_shows(const ViewSettings& view, bool Overlay::*what);

}  // namespace si
