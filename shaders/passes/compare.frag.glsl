// Each pixel's visibility held against the truth: which are wrong. Why, passes/causes.frag.glsl finds for those alone.
#include "lib/truth.glsl"
#include "lib/seen_surface.glsl"
#include "lib/visibility.glsl"
#include "lib/drawn_visibility.glsl"

layout(location = 0) out vec2 classified_out;  // classification()

void main() {
    vec4 reference = reference_here();
    classified_out = vec2(0.0);
    gl_FragDepth = MARK_NONE;
    if (!counts(reference)) return;
#if MAP_HOLDS_ALL
    bool outside = false;
#else
    bool outside = place_in_map(make_receiver(seen_surface(), LIGHT_INDEX)) == PLACE_OUTSIDE;
#endif
    float v = drawn_visibility();
    int bits = compared_bits(v, reference, outside);
    classified_out = classification(ARTEFACT_NONE, bits, v);
    gl_FragDepth = (bits & FALSE_LIGHT) != 0    ? MARK_FALSE_LIGHT
                   : (bits & FALSE_SHADOW) != 0 ? MARK_FALSE_SHADOW
                   : (bits & FAINT) != 0        ? MARK_FAINT
                                                : MARK_NONE;
}
