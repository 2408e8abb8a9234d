#include "renderer/bundle/redrawn_maps.h"

#include <algorithm>
#include <utility>

namespace si {

CasterRaster first_raster(const Bundle& bundle) {
    const auto light = std::ranges::find_if(bundle.lights, [](const BundleLight& l) { return !l.maps.empty(); });
    if (light == bundle.lights.end()) return {};
    const BundleMap& map = light->maps.front();
    const double sign = map.depth.convention.reversed ? -1 : 1;
    return {.offset_factor = sign * map.raster.offset_factor.value_or(0),
            .offset_units = sign * map.raster.offset_units.value_or(0),
            .offset_clamp = sign * map.raster.offset_clamp.value_or(0),
            .cull = map.raster.cull.value_or(Cull::None)};
}

std::shared_ptr<const ImportedMaps> redrawn_maps(const ImportedMaps& maps, const Settings& settings,
                                                 const CasterRaster& begun) {
    std::vector<CasterRaster> raster = maps.raster;
    const BiasSettings& bias = settings.bias;
    for (std::size_t i = 0; i < raster.size(); ++i) {
        const double sign = maps.views->views[i].curve.convention.reversed ? -1 : 1;
        CasterRaster& r = raster[i];
        if (bias.raster_slope != begun.offset_factor) r.offset_factor = sign * bias.raster_slope;
        if (bias.raster_units != begun.offset_units) r.offset_units = sign * bias.raster_units;
        if (bias.raster_clamp != begun.offset_clamp) r.offset_clamp = sign * bias.raster_clamp;
        if (settings.caster.cull != begun.cull) r.cull.reset();  // caster.cull decides
    }
    const MapSize given = maps.size();
    const auto side = [&](int texels) {
        return std::max(1, int(std::int64_t(texels) * settings.map.resolution / given.longest()));
    };
    return drawn_maps(*maps.views, {side(given.width), side(given.height)}, std::move(raster));
}

}  // namespace si
