// Distance of each fragment's look-up from its place in double precision, in texels.
#include "lib/precision.glsl"
vec4 overlay(Receiver r) { return vec4(value_or_nothing(precision_here().x)); }
