// Texels of the map that are fetched for this fragment.
#include "lib/arriving.glsl"

vec4 overlay(Receiver r) {
    if (r.where == NO_MAP) return vec4(NOTHING);
    if (is_guarded(r)) return vec4(0.0);
#if SKIPS_UNLIT
    if (!faces_light(r)) return vec4(0.0);
#ifndef SEPARATE_VISIBILITY
    if (!needs_visibility(r.light, r.surface, r.to_light, r.distance_m)) return vec4(0.0);
#endif
#endif
    map_visibility(r);
    return vec4(isnan(found.taps) ? frame_pixel().z : found.taps);
}
