// The least bias under which the triangle's plane does not shadow itself, in texels.
#include "lib/least_bias.glsl"

vec4 overlay(Receiver r) {
    if (r.where != INSIDE || r.geometric_n_dot_l <= 0.0) return vec4(NOTHING);
    return vec4(least_bias(r, plane_gradient(r)) / texel_depth(r));
}
