// Texels of the shadow map as quads in the scene; one instance a slab.
#include "lib/frame.glsl"
layout(location = 0) in vec3 corner_00;  // relative to the frame's origin
layout(location = 1) in vec3 corner_10;
layout(location = 2) in vec3 corner_01;
layout(location = 3) in vec3 corner_11;
layout(location = 4) in float biased_in;
out vec2 within;
flat out float biased;

void main() {
    vec3 p = gl_VertexID == 0 ? corner_00 : gl_VertexID == 1 ? corner_10 : gl_VertexID == 2 ? corner_01 : corner_11;
    within = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    biased = biased_in;
    gl_Position = frame.clip_from_relative * vec4(p, 1.0);
}
