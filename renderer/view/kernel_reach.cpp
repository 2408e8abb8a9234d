#include "renderer/view/kernel_reach.h"

#include <algorithm>

namespace si {

double widest_penumbra_texels(const FittedLight& light, int resolution) {
    double widest = 0;
    for (const LightView& view : light.views) {
        const DepthCurve& c = view.curve;
        const double depth_m = c.far - c.near;
        // The penumbra's radius on a receiver at the far plane, of an occluder at the near plane.
        const double width_m = light.type == LightType::Directional ? light.size * depth_m
                               : c.perspective                      ? light.size * depth_m / c.near
                                                                    : light.size * c.far / std::max(c.near, 1e-6);
        widest = std::max(widest, width_m / view.texel_size(c.far, resolution));
    }
    return widest;
}

Reach reach_under(const Settings& settings, const FittedLight& light, int resolution) {
    const Filter& row = filter_of(settings);
    if (!row.reads_light_size || !light.casts) return reach_of(settings);
    return reach_of(settings, widest_penumbra_texels(light, resolution));
}

}  // namespace si
