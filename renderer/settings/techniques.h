// Tables of techniques: a new kernel or overlay is one row here and one GLSL file.
#pragma once

#include <span>
#include <string_view>

#include "renderer/settings/param.h"
#include "renderer/settings/settings.h"

namespace si {

/// A shadow filter kernel. Its file defines `float filter_visibility(Receiver r)`.
struct Filter {
    std::string_view key, label, help;
    std::string_view file;      ///< below shaders/
    int size = 1;               ///< taps per axis, the define KERNEL_SIZE
    bool bilinear = false;      ///< each tap weighs 2x2 texels
    double reach_texels = 0.5;  ///< kappa: how far a tap's texel centre may lie from the receiver, per axis
    int gathers = 0;            ///< textureGather calls per light with method gather; 0: cannot
    int sampler_taps = 1;       ///< texture calls per light with method sampler
    /// Texels that are fetched per light, either way: a bilinear call of a shadow sampler compares 2x2, as a gather
    /// fetches.
    int texels(bool sampler) const { return !sampler && gathers > 0 ? 4 * gathers : (bilinear ? 4 : 1) * sampler_taps; }
};
/// Whether a kernel compares in a shadow sampler: where filter.method asks for it and the map's format can.
bool uses_sampler(const Settings& settings);

/// How an overlay's values come about: per visible fragment, along the edges of all triangles, or as a count of
/// every fragment whatever its depth.
enum class OverlayDraw { Fragments, Edges, Count };

/// An overlay. Its file defines `vec4 overlay(Receiver r)`; scalars in x, NaN where undefined.
struct Overlay {
    std::string_view key, label, unit, help;
    std::string_view file;
    bool scalar = true;             ///< x goes through the colour scale; otherwise rgba as it is
    double min = 0, max = 1;        ///< colour scale when view.overlay_range is declared
    bool diverging = false;         ///< the scale is centred on zero
    bool reads_visibility = false;  ///< asks for the visibility texture
    bool reads_truth = false;       ///< asks for the traced truth and for what it makes of the visibility
    OverlayDraw draw = OverlayDraw::Fragments;
};

std::span<const Filter> filters();
std::span<const Overlay> overlays();
std::span<const Choice> filter_choices();
std::span<const Choice> overlay_choices();  ///< "none" first

}  // namespace si
