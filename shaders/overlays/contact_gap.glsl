// Largest width in metres of the lit strip on this surface beside a caster that touches it: equivalent depth bias along
// the light ray, times the sine of the angle between ray and normal. A normal offset leaves such a strip only behind a
// caster that leans along the rays. An offset across the ray also moves shadows over the surface.
#include "lib/least_bias.glsl"
#include "lib/bias_along_ray.glsl"

vec4 overlay(Receiver r) {
    if (r.where != INSIDE || !faces_light(r)) return vec4(NOTHING);
    float along_ray_m = metres_towards_light(r, equivalent_depth_bias(r, plane_gradient(r))) / axis_per_ray(r);
    float cosine = min(r.geometric_n_dot_l, 1.0);
    float moved_m = 0.0;
#if BIAS_NORMAL_OFFSET && bias_normal_by == bias_normal_by_sideways
    moved_m = length(normal_offset(bias_normal_of(r.surface), r.to_light, r.texel_m)) * cosine;
#endif
    return vec4(along_ray_m * sqrt(1.0 - cosine * cosine) + moved_m);
}
