// The table of filter kernels: a new one is one row here and one GLSL file.
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

std::span<const Filter> filters();
std::span<const Choice> filter_choices();

}  // namespace si
