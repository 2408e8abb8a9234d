// Acne of pixels that are less than wholly lit and yet not wrong.
#include "lib/seen_surface.glsl"
#include "lib/visibility.glsl"
#include "lib/truth.glsl"
#include "lib/cause.glsl"
#include "lib/drawn_visibility.glsl"

layout(location = 0) out vec2 judged_out;  // judgement()

void main() {
    vec4 truth = truth_here();
    float v = drawn_visibility();
    Receiver r = make_receiver(seen_surface(), LIGHT_INDEX);
    Evidence e = gather_evidence(r, v, truth, more_truth_here());
    int place = place_in_map(r);
    bool acne = place == PLACE_INSIDE && is_acne(e, 1.0 - RIGHT_VISIBILITY);
    judged_out = judgement(ARTEFACT_NONE, compared_bits(v, truth, place == PLACE_OUTSIDE) | int(acne) * ANY_ACNE, v);
}
