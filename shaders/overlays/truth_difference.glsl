// Drawn visibility minus the reference, at counted pixels.
#include "lib/truth.glsl"
vec4 overlay(Receiver r) {
    vec4 reference = reference_here();
    return vec4(counts(reference) ? classified_visibility(classified_here()) - true_visibility(reference) : NOTHING);
}
