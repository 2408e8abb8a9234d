#include "renderer/view/lights/kernel_reach.h"

#include <algorithm>
#include <limits>

namespace si {

double max_penumbra_radius_texels(const FittedLight& light, MapSize size) {
    double widest = 0;
    for (const LightView& view : light.views) {
        // The widest penumbra of a warped view lies in its first or last row: ranges grow with w, texels with w or its
        // square.
        for (const double row : {0.0, 1.0}) {
            const DepthCurve c = view.curve.curve_at_row(row);
            const double depth_m = c.far - c.near;
            // Penumbra radius on a receiver at the far plane, cast by an occluder at the near plane.
            const double width_m = light.type == LightType::Directional ? light.size * depth_m
                                   : c.perspective                      ? light.size * depth_m / c.near
                                                                        : light.size * c.far / std::max(c.near, 1e-6);
            for (const double u : {0.0, 0.5, 1.0})
                widest =
                    std::max(widest, width_m / view.texel_size_at(view.position_ws({u, row}, c.far), size).shortest);
        }
    }
    return widest;
}

double smallest_texel_m(const FittedLight& light, MapSize size) {
    double finest = std::numeric_limits<double>::infinity();
    for (const LightView& view : light.views) finest = std::min(finest, view.texel_size_range(size).shortest);
    return finest;
}

Reach kernel_reach_in_light(const Settings& settings, const FittedLight& light, MapSize size) {
    const Filter& row = filter_of(settings);
    if (!light.casts) return reach_of(settings);
    if (row.reads_light_size) return reach_of(settings, max_penumbra_radius_texels(light, size));
    return reach_of(settings, settings.filter.radius / smallest_texel_m(light, size));
}

double edge_reach_texels(const Settings& settings, const FittedLight& light, MapSize size) {
    return light.casts ? kernel_reach_in_light(settings, light, size).edge + settings.map.blur_texels : 0;
}

}  // namespace si
