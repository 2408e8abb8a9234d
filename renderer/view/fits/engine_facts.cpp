#include "renderer/view/fits/engine_facts.h"

#include <algorithm>

namespace si {

MapFacts map_facts(const FittedLight* light, const Settings& settings) {
    MapFacts facts;
    constexpr int kMinTexels = 3;
    facts.texels = std::max(settings.map.resolution, kMinTexels);
    facts.format = settings.map.format;
    facts.reversed_z = settings.map.reversed_z;
    const auto index = std::size_t(std::clamp(settings.view.light, 0, kMaxLights - 1));
    facts.cascades = settings.lights[index].cascades;
    if (!light || light->views.empty()) return facts;
    const LightView& view = light->views.front();
    const double depth_m = view.curve.far - view.curve.near;
    const double middle_m = (view.curve.far + view.curve.near) / 2;
    const double width_m = 2 * view.half_extent() * (view.curve.perspective ? middle_m : 1);
    // A map of nothing has no length that numbers could count in.
    if (depth_m > 0 && width_m > 0) {
        facts.depth_m = depth_m;
        facts.width_m = width_m;
    }
    return facts;
}

}  // namespace si
