// Visibility of one light from one surface point: guards outside the map, then the chosen kernel.
#include "lib/receiver.glsl"
#include "lib/compare.glsl"
#include "lib/map_bounds.glsl"
#include "shared/classified.h"

#define UNKNOWN uintBitsToFloat(0x7fc00000u)

/// Further results of a kernel besides visibility; NaN if not given.
struct Filtered {
    float blocker_m;        // mean distance from casters to the receiver along the axis, metres
    float penumbra_texels;  // width of the penumbra
    float taps;             // texels fetched
    float variance;         // variance of depths, in squares of the map's range
    vec4 moments;           // moments read, as in moments_of()
    float mean;             // mean depth by the moments, as a share of the map's range
    float margin;           // below 0: no distribution of depths has these moments
    float own;              // compared depth, as a share of the range
    float bound;            // upper bound of visibility before light-bleed reduction
};
Filtered found = Filtered(UNKNOWN, UNKNOWN, UNKNOWN, UNKNOWN, vec4(UNKNOWN), UNKNOWN, UNKNOWN, UNKNOWN, UNKNOWN);

#include FILTER_FILE

/// Returns the visibility outside the map, by map.outside.
float outside_visibility() {
#if map_outside == map_outside_lit
    return 1.0;
#else
    return 0.0;
#endif
}

/// Returns true when guarded_visibility() answers the look-up without the map.
bool is_guarded(Receiver r) {
    bool guarded = r.where == BEHIND || r.where == OUTSIDE_CASTER_REGION;
#if map_far_guard
    guarded = guarded || r.where == OUTSIDE_FAR;
#endif
#if map_wrap == map_wrap_range
    guarded = guarded || any(lessThan(r.uvd_offset.xy, vec2(0.0))) || any(greaterThan(r.uvd_offset.xy, vec2(1.0)));
#endif
    return guarded;
}

/// Returns the visibility of a guarded look-up.
float guarded_visibility(Receiver r) {
    // Outside the caster region all is lit, independent of map.wrap and map.outside.
    return r.where == OUTSIDE_CASTER_REGION ? 1.0 : outside_visibility();
}

/// Returns the visibility by guards, bounds or kernel: 1 lit, 0 in shadow. Ignores the side that faces away from the light.
float map_visibility(Receiver r) {
    if (is_guarded(r)) return guarded_visibility(r);
#if !BIAS_PER_TEXEL
    r.reference = reference_of(r.reference);
#endif
#if USES_BOUNDS
    float answer = bounded_visibility(r);
    if (answer >= 0.0) {
        found.taps = 0.0;
        return answer;
    }
#endif
    return filter_visibility(r);
}

/// Returns the visibility of a light at a surface, 1 lit to 0 in shadow; blends two views if needed.
float light_visibility(Surface s, int light) {
    if (LIGHT_CASTS[light] == 0 || !s.receives) return 1.0;
    Receiver r = make_receiver(s, light);
    // A surface that faces away from the light shadows itself.
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

/// Returns the place of a surface relative to the map: PLACE_INSIDE also if no map is needed, PLACE_OFFSET_OUTSIDE if only
/// the normal offset leaves the map.
int place_in_map(Receiver r) {
    if (r.where == NO_MAP || r.where == OUTSIDE_CASTER_REGION) return PLACE_INSIDE;
    if (r.where != INSIDE) return PLACE_OUTSIDE;
    bool led = any(lessThan(r.uvd_offset.xy, vec2(0.0))) || any(greaterThan(r.uvd_offset.xy, vec2(1.0)));
    return led ? PLACE_OFFSET_OUTSIDE : PLACE_INSIDE;
}
