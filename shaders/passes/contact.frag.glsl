// Contact shadows: from each surface a ray is marched towards the light through the camera's depth buffer.
// Sousa, Kasyan, Schulz, Secrets of CryENGINE 3 Graphics Technology, SIGGRAPH 2011 (screen-space directional occlusion);
// Karis and others, contact shadows in Unreal Engine 4.14, 2016.
#include "lib/seen_surface.glsl"
#include "lib/camera_depth.glsl"
#include "lib/disk.glsl"

uniform float length_m, thickness_m;
uniform int steps;

layout(location = 0) out float lit_out;

const float RISES_PIXELS = 0.25;  // least height of a blocker above the surface's plane, in pixels

/// Returns true when a visible surface blocks the ray of `s` at the point `p`.
bool is_blocked_at(Surface s, vec3 p) {
    vec3 eye = (frame.eye_from_relative * vec4(p, 1.0)).xyz;
    float z = -eye.z;
    if (!(z > 0.0)) return false;
    vec2 ndc = eye.xy / half_picture_m(z);
    if (any(greaterThanEqual(abs(ndc), vec2(1.0)))) return false;
    ivec2 size = textureSize(camera_depth_map, 0), pixel = ivec2((0.5 * ndc + 0.5) * vec2(size));
    float depth = texelFetch(camera_depth_map, pixel, 0).r;
    if (depth == 0.0) return false;
    float seen_z = camera_z(depth);
    vec2 half_m = half_picture_m(seen_z), centre = (vec2(pixel) + 0.5) / vec2(size) * 2.0 - 1.0;
    vec3 seen = (frame.relative_from_eye * vec4(centre * half_m, -seen_z, 1.0)).xyz;
    float rises_m = dot(seen - s.position, s.geometric);
    return rises_m > RISES_PIXELS * 2.0 * half_m.y / float(size.y) && z > seen_z && z - seen_z < thickness_m;
}

void main() {
    lit_out = 1.0;
    Surface s = seen_surface();
    if (!s.receives) return;
    float distance_m;
    vec3 to_light = direction_to(LIGHT_INDEX, s.position, distance_m);
    if (!faces_light(s, to_light)) return;
    float reach_m = LIGHT_TYPE[LIGHT_INDEX] == LIGHT_DIRECTIONAL ? length_m : min(length_m, distance_m);
    float first = pixel_angle(s.pixel) / 6.28318531;
    for (int i = 0; i < steps; ++i)
        if (is_blocked_at(s, s.position + to_light * (reach_m * (float(i) + first) / float(steps)))) {
            lit_out = 0.0;
            return;
        }
}
