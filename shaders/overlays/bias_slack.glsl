// Equivalent depth bias minus the needed bias, in texels.
#include "lib/least_bias.glsl"

vec4 overlay(Receiver r) {
    if (r.where != INSIDE || !faces_light(r)) return vec4(NOTHING);
    vec2 gradient = plane_gradient(r);
    return vec4(texels_nearer(r, equivalent_depth_bias(r, gradient)) - texels_nearer(r, least_bias(r, gradient)));
}
