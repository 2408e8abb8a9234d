// Own minus stored distance along the light's ray, metres: above zero something lies before the fragment.
#include "lib/bias_along_ray.glsl"

vec4 overlay(Receiver r) {
    if (r.where >= BEHIND) return vec4(NOTHING);
    vec4 curve = frame.views[r.layer].curve;
    bool perspective = LIGHT_PERSPECTIVE[r.light] != 0;
    float stored = map_depth(r.uvd.xy, r.layer);
    float along_axis = metres_from_depth(r.uvd.z, curve.x, curve.y, perspective) -
                       metres_from_depth(stored, curve.x, curve.y, perspective);
    return vec4(along_axis / axis_per_ray(r));
}
