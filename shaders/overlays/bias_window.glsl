// Room for bias in texels: distance from the receiver to the caster nearest the light, minus the needed bias of the
// receiver's plane. At or below zero no depth bias is right.
#include "lib/truth.glsl"
#include "lib/least_bias.glsl"
#include "lib/bias_along_ray.glsl"

vec4 overlay(Receiver r) {
    vec4 reference = reference_here();
    if (!counts(reference) || r.where != INSIDE || reference.y < 0.0) return vec4(NOTHING);  // no caster before it
    float gap_texels = reference.y * axis_per_ray(r) / r.texel_m;
    return vec4(gap_texels - texels_nearer(r, least_bias(r, plane_gradient(r))));
}
