// How far from its place in double precision each fragment is looked up, in texels.
#include "lib/precision.glsl"
vec4 overlay(Receiver r) { return vec4(found_or_nothing(precision_here().x)); }
