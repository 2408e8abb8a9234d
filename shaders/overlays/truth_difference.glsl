// The map's visibility minus the true one, where pixels count.
#include "lib/truth.glsl"
vec4 overlay(Receiver r) { return vec4(counts(truth_here()) ? judged_here().y : NOTHING); }
