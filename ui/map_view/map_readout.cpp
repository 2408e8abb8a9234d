#include "ui/map_view/map_readout.h"

#include <fmt/format.h>

#include <cmath>

namespace si {
namespace {

/// Six digits: what tells neighbouring texels apart.
std::string exact_metres(double metres) {
    return std::isfinite(metres) ? fmt::format("{:.6g} m", metres) : "no distance";
}

}  // namespace

std::pair<std::string, std::string> texel_readout(glm::ivec2 texel, glm::ivec2 size, const FloatImage* values,
                                                  const DepthCurve& curve, const TexelUsage* usage, bool frozen) {
    std::string where = fmt::format("texel {}, {}", texel.x, texel.y);
    if (usage && usage->resolution() == size.x)
        where += fmt::format("   read by {} {}pixels", usage->pixels(texel), frozen ? "frozen " : "");
    if (!values || values->width != size.x || values->height != size.y) return {where, {}};
    const double stored = values->at(texel.x, size.y - 1 - texel.y);
    const double row = (texel.y + 0.5) / size.y;
    const double z = curve.at_row(row).distance(stored), share = (z - curve.near) / (curve.far - curve.near);
    // Nine digits tell any two 32-bit depths apart.
    const std::string depth = fmt::format("{}   stored {:.9g}   linear {:.6g}", exact_metres(z), stored, share);
    return {where, stored == curve.convention.far_depth() ? depth + "   nothing drawn" : depth};
}

}  // namespace si
