// Causes of wrong pixels that should be dark (FOR_FALSE_LIGHT) or lit (FOR_FALSE_SHADOW).
#include "lib/seen_triangle.glsl"
#include "lib/visibility.glsl"
#include "lib/truth.glsl"
#include "lib/cause.glsl"
#include "lib/drawn_visibility.glsl"

layout(location = 0) out vec2 classified_out;  // classification()

void main() {
    vec4 reference = reference_here(), more = more_reference_here();
    Receiver r = make_receiver(seen_triangle(), LIGHT_INDEX);
    float v = drawn_visibility();
    int place = place_in_map(r);
    int bits = compared_bits(v, reference, place == PLACE_OUTSIDE);
#if HAS_MAP
    Evidence e = gather_evidence(r, v, reference, more);
#endif
    Cause why;
    if ((hard_visibility(more) < 0.5) == (v < 0.5))
        why = cause(ARTEFACT_PENUMBRA, 0);
    else
#if !HAS_MAP
        why = cause(ARTEFACT_NO_MAP, 0);
#elif FOR_FALSE_LIGHT
        why = cause_of_false_light(e, place);
#else
#if HAS_CONTACTS
        why = map_visibility(r) >= 0.5 ? cause(ARTEFACT_CONTACT, 0) : cause_of_false_shadow(e, place);
#else
        why = cause_of_false_shadow(e, place);
#endif
    if (why.artefact == ARTEFACT_ACNE && true_visibility(reference) == 1.0) bits |= ANY_ACNE;
#endif
    if (why.seam) bits |= SEAM;
    classified_out = classification(why.artefact, bits | why.also << ALSO_SHIFT, v);
}
