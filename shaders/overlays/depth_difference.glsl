// Own minus stored distance along the light's ray, metres. Above zero a caster is before the fragment.
#include "lib/bias_along_ray.glsl"

vec4 overlay(Receiver r) {
    if (r.where >= BEHIND) return vec4(NOTHING);
    float along_axis = metres_at(r, r.uvd.xy, r.uvd.z) - metres_at(r, r.uvd.xy, map_depth(r.uvd.xy, r.layer));
    return vec4(along_axis / axis_per_ray(r));
}
