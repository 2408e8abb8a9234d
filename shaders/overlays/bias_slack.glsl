// What the bias is worth against acne, less what is needed, in texels.
#include "lib/least_bias.glsl"

vec4 overlay(Receiver r) {
    if (r.where != INSIDE || r.geometric_n_dot_l <= 0.0) return vec4(NOTHING);
    vec2 gradient = plane_gradient(r);
    return vec4((bias_worth(r, gradient) - least_bias(r, gradient)) / texel_depth(r));
}
