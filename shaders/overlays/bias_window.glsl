// Room for bias: how far before the receiver the map stores the surface nearest the light, in depth, less the bias that the
// receiver's plane needs. Where it is not above zero, no depth bias is right.
#include "lib/truth.glsl"
#include "lib/least_bias.glsl"
#include "lib/bias_along_ray.glsl"

vec4 overlay(Receiver r) {
    vec4 truth = truth_here();
    if (!counts(truth) || r.where != INSIDE || truth.y < 0.0) return vec4(NOTHING);  // nothing stands before it
    float gap_m = truth.y * axis_per_ray(r), gap = gap_m * r.depth_per_m;
    // Depth rises faster towards a perspective light: n f / (f - n) (1 / (z - gap) - 1 / z).
    if (LIGHT_PERSPECTIVE[r.light] != 0) gap *= r.w / max(r.w - gap_m, 1e-6 * r.w);
    return vec4((gap - least_bias(r, plane_gradient(r))) / texel_depth(r));
}
