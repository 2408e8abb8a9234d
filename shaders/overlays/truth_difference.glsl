// The map's visibility minus the true one, where pixels count.
#include "lib/truth.glsl"
vec4 overlay(Receiver r) {
    vec4 truth = truth_here();
    return vec4(counts(truth) ? judged_visibility(judged_here()) - true_visibility(truth) : NOTHING);
}
