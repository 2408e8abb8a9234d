// The mean and mean square of depths about each texel of the shadow maps, as the moments pass leaves them. Depths are
// shares of the map's range along its axis, 0 near to 1 far, whatever the map's format and direction.
#include "shared/units.h"
#include "lib/shadow_map.glsl"
layout(binding = UNIT_MOMENTS) uniform MAPS moments_map;

/// The share of the range at a stored or compared depth; the depth itself where it is linear.
float share_of_range(float depth, float near, float far, bool perspective) {
    if (!perspective) return map_reversed_z != 0 ? 1.0 - depth : depth;
    return (metres_from_depth(depth, near, far, true) - near) / (far - near);
}

float share_of_range(float depth, Receiver r) {
    vec4 curve = frame.views[r.layer].curve;
    return share_of_range(depth, curve.x, curve.y, LIGHT_PERSPECTIVE[r.light] != 0);
}

/// The moments at a place of the map, blended of 2x2 texels.
vec2 map_moments(Receiver r, vec2 at) {
    vec2 moments = texture(moments_map, IN_LAYER(at, r.layer)).rg;
#ifdef MARK_TEXELS
    map_gather(round(at * float(map_resolution)) / float(map_resolution), r.layer);  // the 2x2 that are blended
#endif
#ifdef MAP_TRIALS
    if (map_is_unfiltered) {
        float share = share_of_range(map_depth(at, r.layer), r);
        moments = vec2(share, share * share);
    }
    if (beyond_answer >= 0.0 && (any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0)))))
        moments = beyond_answer > 0.5 ? vec2(1.0) : vec2(0.0);
#endif
    return moments;
}
