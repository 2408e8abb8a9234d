// Distance of each fragment's depth from its plane in double precision, in steps of a 32-bit float.
#include "lib/precision.glsl"
vec4 overlay(Receiver r) { return vec4(value_or_nothing(precision_here().y)); }
