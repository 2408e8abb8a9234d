#include "renderer/passes/compared_maps.h"

#include "renderer/settings/map_storage.h"

namespace si {

void place_compared_maps(FrameState& f, const gl::Target& maps) {
    f.plan.place(Result::ShadowMaps, {&maps, shared::UNIT_SHADOW_MAP, &f.gl.map_nearest});
    if (!is_colour(f.settings.map.format))
        f.plan.place(Result::ShadowMaps, {&maps, shared::UNIT_SHADOW_MAP_COMPARE, &f.gl.map_compare});
}

}  // namespace si
