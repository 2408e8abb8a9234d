// Visibility of one light from one surface point: the guards, then the chosen kernel.
#include "lib/receiver.glsl"
#include "lib/compare.glsl"
#include "lib/map_bounds.glsl"
#include "shared/classified.h"

#define UNKNOWN uintBitsToFloat(0x7fc00000u)

/// What a kernel learns besides visibility; NaN where it does not say.
struct Filtered {
    float blocker_m;        // how far along the axis what it took for the occluder lies before the receiver
    float penumbra_texels;  // width of the penumbra that it made
    float taps;             // texels fetched
    float variance;         // of the depths, in squares of the map's range
    vec4 moments;           // that it read, as moments_of() counts them
    float mean;             // the depth that they say, as a share of the map's range
    float margin;           // below 0: no distribution of depths has them
    float own;              // the depth that it compared, as a share of the range
    float bound;            // the most that can be lit by them, before light-bleed reduction
};
Filtered found = Filtered(UNKNOWN, UNKNOWN, UNKNOWN, UNKNOWN, vec4(UNKNOWN), UNKNOWN, UNKNOWN, UNKNOWN, UNKNOWN);

#include FILTER_FILE

/// Of what lies where the map says nothing.
float outside_visibility() {
#if map_outside == map_outside_lit
    return 1.0;
#else
    return 0.0;
#endif
}

/// Whether the look-up is answered without the map, by guarded_visibility().
bool is_guarded(Receiver r) {
    bool guarded = r.where == BEHIND || r.where == BEYOND_SHADOWS;
#if map_far_guard
    guarded = guarded || r.where == OUTSIDE_FAR;
#endif
#if map_wrap == map_wrap_range
    guarded = guarded || any(lessThan(r.uvd_offset.xy, vec2(0.0))) || any(greaterThan(r.uvd_offset.xy, vec2(1.0)));
#endif
    return guarded;
}

float guarded_visibility(Receiver r) {
    // Lit by construction, whatever map.wrap and map.outside say of the map's sides.
    return r.where == BEYOND_SHADOWS ? 1.0 : outside_visibility();
}

/// What the map says of a receiver in front of the guards' backs: 1 lit, 0 in shadow.
float map_visibility(Receiver r) {
    if (is_guarded(r)) return guarded_visibility(r);
#if !BIAS_PER_TEXEL
    r.reference = reference_of(r.reference);
#endif
#if ASKS_BOUNDS
    float answer = bounded_visibility(r);
    if (answer >= 0.0) {
        found.taps = 0.0;
        return answer;
    }
#endif
    return filter_visibility(r);
}

float light_visibility(Surface s, int light) {
    if (LIGHT_CASTS[light] == 0 || !s.receives) return 1.0;
    Receiver r = make_receiver(s, light);
    // A surface turned away from the light shadows itself; no tap can say it better.
    float facing = float(faces_light(r));
#if SKIPS_UNLIT
    if (facing == 0.0) return 0.0;
#endif
    float v = map_visibility(r);
#if VIEWS_BLEND
    Filtered nearer = found;
    if (r.blend > 0.0) v = mix(v, map_visibility(receiver_in(s, light, r.other_layer)), r.blend);
    found = nearer;
#endif
    return facing > 0.0 ? v : 0.0;
}

/// Whether the map holds the surface, or need not, and if so, whether the normal offset leads the look-up out of it.
int place_in_map(Receiver r) {
    if (r.where == NO_MAP || r.where == BEYOND_SHADOWS) return PLACE_INSIDE;
    if (r.where != INSIDE) return PLACE_OUTSIDE;
    bool led = any(lessThan(r.uvd_offset.xy, vec2(0.0))) || any(greaterThan(r.uvd_offset.xy, vec2(1.0)));
    return led ? PLACE_LED_OUTSIDE : PLACE_INSIDE;
}
