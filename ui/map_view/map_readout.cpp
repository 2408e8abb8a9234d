#include "ui/map_view/map_readout.h"

#include <fmt/format.h>

#include <cmath>

namespace si {
namespace {

/// Formats a value with six digits, which distinguish neighbouring texels.
std::string exact_metres(double metres) {
    return std::isfinite(metres) ? fmt::format("{:.6g} m", metres) : "no distance";
}

}  // namespace

std::pair<std::string, std::string> texel_readout(glm::ivec2 texel, glm::ivec2 size, const FloatImage* values,
                                                  const DepthCurve& curve, const TexelUsage* usage, bool frozen,
                                                  const ShownMap& shown, bool linear) {
    std::string where = fmt::format("texel {}, {}", texel.x, texel.y);
    if (usage && usage->resolution() == size.x)
        where += fmt::format("   read by {} {}pixels", usage->pixels(texel), frozen ? "frozen " : "");
    if (shown.mip > 0) {
        texel = (2 * texel + 1) * shown.texels / (2 * size);  // texel of the full map under the middle of the mip texel
        where += fmt::format("   in mip level {} texel {}, {}", shown.mip, texel.x, texel.y);
        size = shown.texels;
    }
    if (!values || values->width != size.x || values->height != size.y) return {where, {}};
    const double stored = values->at(texel.x, size.y - 1 - texel.y);
    const DepthCurve here = curve.curve_at_row((texel.y + 0.5) / size.y);
    if (shown.channel > 0 && linear)
        return {where, fmt::format("{}   of a depth alone at {:.6g} of the range   {}", shown.name, stored,
                                   exact_metres(here.near + stored * (here.far - here.near)))};
    if (shown.channel > 0) return {where, fmt::format("{}   {:.9g}", shown.name, stored)};
    const double z = here.distance(stored), share = (z - curve.near) / (curve.far - curve.near);
    // Nine digits distinguish any two 32-bit depths.
    const std::string depth = fmt::format("{}   stored {:.9g}   linear {:.6g}", exact_metres(z), stored, share);
    return {where, stored == curve.convention.far_depth() ? depth + "   nothing drawn" : depth};
}

}  // namespace si
