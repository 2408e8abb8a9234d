// Acne of pixels that are slightly darkened without being wrong.
#include "lib/seen_triangle.glsl"
#include "lib/visibility.glsl"
#include "lib/truth.glsl"
#include "lib/cause.glsl"
#include "lib/drawn_visibility.glsl"

layout(location = 0) out vec2 classified_out;  // classification()

void main() {
    vec4 reference = reference_here();
    float v = drawn_visibility();
    Receiver r = make_receiver(seen_triangle(), LIGHT_INDEX);
    Evidence e = gather_evidence(r, v, reference, more_reference_here());
    int place = place_in_map(r);
    bool acne = place == PLACE_INSIDE && is_acne(e, 1.0 - RIGHT_VISIBILITY);
    classified_out = classification(ARTEFACT_NONE, compared_bits(v, reference, place == PLACE_OUTSIDE) | int(acne) * ANY_ACNE, v);
}
