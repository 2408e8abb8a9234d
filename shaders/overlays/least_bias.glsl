// Least bias without self-shadowing of the triangle's plane, in texels.
#include "lib/least_bias.glsl"

vec4 overlay(Receiver r) {
    if (r.where != INSIDE || !faces_light(r)) return vec4(NOTHING);
    return vec4(texels_nearer(r, least_bias(r, plane_gradient(r))));
}
