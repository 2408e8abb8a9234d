#include "renderer/inspect/kernel_taps.h"

namespace si {

int footprint_width(const Filter& filter) {
    return filter.size + (filter.bilinear ? 1 : 0);
}

std::vector<KernelTexel> kernel_texels(const Filter& filter, const glm::dvec2& centre) {
    const int width = footprint_width(filter), radius = filter.size / 2;
    const glm::dvec2 at = filter.bilinear ? centre - 0.5 : centre;
    const glm::dvec2 corner = glm::clamp(glm::floor(at), glm::dvec2(-1e9), glm::dvec2(1e9)), f = at - corner;
    // A border texel shares its weight with the one on the far side.
    const auto share = [&](int i, double fraction) {
        if (!filter.bilinear) return 1.0;
        return i == 0 ? 1 - fraction : i == width - 1 ? fraction : 1.0;
    };
    std::vector<KernelTexel> out;
    out.reserve(std::size_t(width) * std::size_t(width));
    for (int y = 0; y < width; ++y)
        for (int x = 0; x < width; ++x)
            out.push_back({glm::ivec2(corner) + glm::ivec2(x - radius, y - radius),
                           share(x, f.x) * share(y, f.y) / double(filter.size * filter.size)});
    return out;
}

}  // namespace si
