#include "renderer/passes/texel_slabs.h"

#include <cmath>

namespace si {

TexelRegion slab_region(const ViewSettings& view, MapSize size) {
    const glm::dvec2 centre = glm::dvec2(view.slabs_u, view.slabs_v) * size.texels();
    const glm::ivec2 first(glm::floor(centre - 0.5 * view.slabs_texels + 0.5));
    TexelRegion region;
    region.first = glm::clamp(first, glm::ivec2(0), size.sides());
    region.size = glm::clamp(first + view.slabs_texels, glm::ivec2(0), size.sides()) - region.first;
    return region;
}

std::optional<double> compared_distance(const LightView& view, const BiasSettings& bias, MapSize size, double stored,
                                        const glm::dvec2& uv) {
    const DepthCurve curve = view.curve.curve_at_row(uv.y);
    const double c = bias.constant;
    if (bias.unit == BiasUnit::Depth) {
        const double shifted = curve.convention.reversed ? stored - c : stored + c;
        const double z = curve.distance(shifted);
        // A perspective curve reaches infinity at a finite depth beyond that of the far plane.
        if (curve.perspective && !(z > 0 && std::isfinite(z))) return std::nullopt;
        return z;
    }
    const double z = curve.distance(stored);
    if (bias.unit == BiasUnit::Metres) return z + c;
    const double moved_m = c * view.texel_size_at(view.position_ws(uv, z), size).longest;
    if (!curve.perspective) return z + moved_m;
    // A texel grows with the distance, so its share of the distance is that of the point to be found.
    const double share = moved_m / z;
    return share < 1 ? std::optional(z / (1 - share)) : std::nullopt;
}

std::vector<TexelSlab> texel_slabs(const LightView& view, const BiasSettings& bias, MapSize size,
                                   const TexelRegion& region, const std::vector<float>& depths, Slabs which) {
    std::vector<TexelSlab> slabs;
    const auto add = [&](glm::ivec2 texel, double z, bool biased) {
        TexelSlab slab{texel, biased, {}};
        for (int i = 0; i < 4; ++i)
            slab.corners[std::size_t(i)] =
                view.position_ws((glm::dvec2(texel) + glm::dvec2(i & 1, i >> 1)) / size.texels(), z);
        slabs.push_back(slab);
    };
    for (int y = 0; y < region.size.y; ++y)
        for (int x = 0; x < region.size.x; ++x) {
            const double stored = depths[std::size_t(y) * std::size_t(region.size.x) + std::size_t(x)];
            if (!std::isfinite(stored) || stored == view.curve.convention.far_depth()) continue;
            const glm::ivec2 texel = region.first + glm::ivec2(x, y);
            const glm::dvec2 uv = (glm::dvec2(texel) + 0.5) / size.texels();
            if (which != Slabs::Biased) add(texel, view.curve.curve_at_row(uv.y).distance(stored), false);
            if (which == Slabs::Stored) continue;
            if (const auto z = compared_distance(view, bias, size, stored, uv)) add(texel, *z, true);
        }
    return slabs;
}

}  // namespace si
