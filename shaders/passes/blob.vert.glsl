// Volume that a disc sweeps from its caster away from the light: a box, or a frustum for spot and point lights.
#include "lib/blob.glsl"
#include "lib/across.glsl"
layout(location = 0) in vec4 caster;  // middle, relative to the frame's origin; radius of the disc there, metres

flat out vec4 disc;  // caster
uniform float end_m;  // length along the light from the caster's middle, metres

// Corners of a box's six sides, two triangles each, counter-clockwise from outside.
const int SIDES[36] = int[](0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5);

void main() {
    Sweep sweep = sweep_of(caster.xyz);
    vec3 u = perpendicular_to(sweep.axis), v = cross(sweep.axis, u);
    int k = SIDES[gl_VertexID];
    vec3 corner = vec3(k & 1, k >> 1 & 1, k >> 2 & 1);
    float along = corner.z * end_m;
    vec2 off_axis = (2.0 * corner.xy - 1.0) * caster.w * spread_at(sweep, along);
    disc = caster;
    gl_Position = frame.clip_from_relative * vec4(caster.xyz + sweep.axis * along + u * off_axis.x + v * off_axis.y, 1.0);
}
