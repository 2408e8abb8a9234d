// The least bias under which the triangle's plane does not shadow itself, in texels.
#include "lib/least_bias.glsl"

vec4 overlay(Receiver r) {
    if (r.where != INSIDE || !faces_light(r)) return vec4(NOTHING);
    return vec4(texels_nearer(r, least_bias(r, plane_gradient(r))));
}
