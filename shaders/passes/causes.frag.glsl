// Why the marked pixels are wrong.
layout(early_fragment_tests) in;
#include "lib/surface.glsl"
#include "lib/visibility.glsl"
#include "lib/truth.glsl"
#include "lib/cause.glsl"
layout(binding = 3) uniform sampler2DArray visibility_map;

layout(location = 0) out vec4 judged_out;  // as in compare.frag.glsl

void main() {
#ifdef MASKED
    if (masked_out()) discard;
#endif
    vec4 truth = truth_here(), more = more_truth_here();
    Receiver r = make_receiver(make_surface(), LIGHT_INDEX);
    float v = texelFetch(visibility_map, ivec3(gl_FragCoord.xy, LIGHT_INDEX), 0).r;
    if (isnan(v)) v = 0.0;
    int place = place_in_map(r);
    int bits = compared_bits(v, truth, place == PLACE_OUTSIDE);
    bool wrong = (bits & (FALSE_SHADOW | FALSE_LIGHT)) != 0;
    Evidence e = gather_evidence(r, v, truth, more);
    Cause why = cause(ARTEFACT_NONE, 0);
    if (wrong && (hard_visibility(more) < 0.5) == (v < 0.5))
        why = cause(ARTEFACT_PENUMBRA, 0);
    else if (wrong)
#if FOR_FALSE_LIGHT
        why = cause_of_false_light(e, place);
#else
        why = cause_of_false_shadow(e, place);
    if ((bits & FAINT) != 0 && place == PLACE_INSIDE && is_acne(e, 1.0 - RIGHT_VISIBILITY)) bits |= ANY_ACNE;
    if (why.artefact == ARTEFACT_ACNE && true_visibility(truth) == 1.0) bits |= ANY_ACNE;
#endif
    if (why.seam) bits |= SEAM;
    bits |= why.also << ALSO_SHIFT;
    judged_out = vec4(float(why.artefact), v - true_visibility(truth), float(bits), v);
}
