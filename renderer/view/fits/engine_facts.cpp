#include "renderer/view/fits/engine_facts.h"

#include <algorithm>

namespace si {

MapFacts map_facts(const LightView& view, const Settings& settings, MapSize size) {
    MapFacts facts{.texels = std::max(size.longest(), kMinMapTexels),
                   .format = settings.map.format,
                   .reversed_z = settings.map.reversed_z,
                   .light = settings.view.light_index()};
    const double depth_m = view.curve.far - view.curve.near;
    const double middle_m = (view.curve.far + view.curve.near) / 2;
    const bool grows = view.curve.perspective && !view.warped();
    const double texel_m =
        (grows ? view.texel_size_at(view.position_ws({0.5, 0.5}, middle_m), size) : view.texel_size_range(size))
            .longest;
    // A map of nothing has no length that numbers could count in.
    if (depth_m > 0 && texel_m > 0) {
        facts.depth_m = depth_m;
        facts.width_m = texel_m * size.longest();
    }
    return facts;
}

MapFacts map_facts(const FittedLight* light, const Settings& settings, MapSize size) {
    if (!light || light->views.empty()) {
        const LightSettings& of = settings.lights[std::size_t(settings.view.light_index())];
        return {.texels = std::max(size.longest(), kMinMapTexels),
                .cascades = of.type == LightType::Directional ? of.cascades : 1,
                .format = settings.map.format,
                .reversed_z = settings.map.reversed_z,
                .light = settings.view.light_index()};
    }
    MapFacts facts = map_facts(light->views.front(), settings, size);
    facts.cascades = light->is_cascaded() ? int(light->views.size()) : 1;
    return facts;
}

}  // namespace si
