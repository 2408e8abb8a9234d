// Visibility of one light from one surface point: the guards, then the chosen kernel.
#include "lib/receiver.glsl"
#include "shared/judged.h"
#include FILTER_FILE

float outside_visibility() {
#if map_outside == map_outside_lit
    return 1.0;
#else
    return 0.0;
#endif
}

/// What the map says of a receiver in front of the guards' backs: 1 lit, 0 in shadow.
float map_visibility(Receiver r) {
    if (r.where == BEHIND) return outside_visibility();
#if map_far_guard
    if (r.where == OUTSIDE_FAR) return outside_visibility();
#endif
#if map_wrap == map_wrap_range
    if (any(lessThan(r.uvd_offset.xy, vec2(0.0))) || any(greaterThan(r.uvd_offset.xy, vec2(1.0))))
        return outside_visibility();
#endif
#if !FILTER_SAMPLER && (map_format == map_format_d16 || map_format == map_format_d24)
    r.reference = clamp(r.reference, 0.0, 1.0);  // as shadow samplers do with formats that hold nothing else
#endif
    return filter_visibility(r);
}

float light_visibility(Surface s, int light) {
    if (LIGHT_CASTS[light] == 0 || !s.receives) return 1.0;
    Receiver r = make_receiver(s, light);
    // A surface turned away from the light shadows itself; no tap can say it better.
    if (!faces_light(r)) return 0.0;
    return map_visibility(r);
}

/// Whether the map holds the surface, and if so, whether the normal offset leads the look-up out of it.
int place_in_map(Receiver r) {
    if (r.where != INSIDE) return r.where == NO_MAP ? PLACE_INSIDE : PLACE_OUTSIDE;
    bool led = any(lessThan(r.uvd_offset.xy, vec2(0.0))) || any(greaterThan(r.uvd_offset.xy, vec2(1.0)));
    return led ? PLACE_LED_OUTSIDE : PLACE_INSIDE;
}
