// Ray-traced visibility: 1 lit to 0 in shadow.
#include "lib/truth.glsl"
vec4 overlay(Receiver r) { return vec4(true_visibility(reference_here())); }
