// How much light one caster's blob leaves on the surface seen.
#include "lib/seen_surface.glsl"
layout(binding = UNIT_CAMERA_DEPTH) uniform sampler2D camera_depth_map;  // reversed: 0 is far

flat in vec4 disc;
uniform vec4 blob;  // softness, opacity, reach (radii, 0: endless)

layout(location = 0) out float lit_out;

const float BEGINS_RADII = 0.25;  // below the caster's middle: it does not darken its own lit side

void main() {
    if (texelFetch(camera_depth_map, ivec2(gl_FragCoord.xy), 0).r == 0.0) discard;
    vec3 p = seen_surface().position;
    LightBlock light = frame.lights[LIGHT_INDEX];
    bool parallel = LIGHT_TYPE[LIGHT_INDEX] == LIGHT_DIRECTIONAL;
    vec3 from_light = disc.xyz - light.position.xyz;
    vec3 axis = parallel ? -light.to_light.xyz : normalize(from_light);
    float along = dot(p - disc.xyz, axis);
    float spread = parallel ? 1.0 : 1.0 + along / max(length(from_light), 1e-6);
    float off_axis = length(p - disc.xyz - axis * along) / (disc.w * spread);  // in radii there
    float radii = along / disc.w;
    float below = clamp(radii / BEGINS_RADII, 0.0, 1.0) * (blob.z > 0.0 ? clamp(1.0 - radii / blob.z, 0.0, 1.0) : 1.0);
    float inside = 1.0 - clamp((off_axis - (1.0 - blob.x)) / max(blob.x, 1e-4), 0.0, 1.0);
    lit_out = 1.0 - blob.y * below * inside;
}
