// The body that a disc sweeps from its caster on, away from the light: a box, or where light spreads, its frustum.
#include "lib/frame.glsl"
layout(location = 0) in vec4 caster;  // middle, relative to the frame's origin; radius of the disc there, metres

flat out vec4 disc;  // the same
uniform float end_m;  // along the light from the middle on

// Corners of a box's six sides, two triangles each, counter-clockwise from outside.
const int SIDES[36] = int[](0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5);

void main() {
    LightBlock light = frame.lights[LIGHT_INDEX];
    bool parallel = LIGHT_TYPE[LIGHT_INDEX] == LIGHT_DIRECTIONAL;
    vec3 from_light = caster.xyz - light.position.xyz;
    vec3 axis = parallel ? -light.to_light.xyz : normalize(from_light);
    vec3 u = normalize(abs(axis.x) > abs(axis.z) ? vec3(-axis.y, axis.x, 0.0) : vec3(0.0, -axis.z, axis.y));
    vec3 v = cross(axis, u);
    int k = SIDES[gl_VertexID];
    vec3 corner = vec3(k & 1, k >> 1 & 1, k >> 2 & 1);
    float along = corner.z * end_m;
    float spread = parallel ? 1.0 : 1.0 + along / max(length(from_light), 1e-6);
    vec2 across = (2.0 * corner.xy - 1.0) * caster.w * spread;
    disc = caster;
    gl_Position = frame.clip_from_relative * vec4(caster.xyz + axis * along + u * across.x + v * across.y, 1.0);
}
