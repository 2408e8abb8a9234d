// Depth pass of the light: positions, moved where an engine moves its casters, and uv for masked materials.
#ifdef MASKED
#include "lib/vertex_colour.glsl"
#endif
layout(location = 0) in vec3 position_os;
#ifdef MOVES_CASTERS
layout(location = 1) in vec3 normal_os;
layout(location = 9) in vec3 normal_row0;
layout(location = 10) in vec3 normal_row1;
layout(location = 11) in vec3 normal_row2;
uniform vec3 away_ws;    // unit, along the map's axis away from the light
uniform vec2 shift_m;    // at any angle, and times 1 - |n.l|
#endif
layout(location = 4) in vec4 row0;
layout(location = 5) in vec4 row1;
layout(location = 6) in vec4 row2;

uniform mat4 clip_from_relative;

void main() {
    vec4 p = vec4(position_os, 1.0);
    vec3 position_rel = vec3(dot(row0, p), dot(row1, p), dot(row2, p));
#ifdef MOVES_CASTERS
    vec3 normal = vec3(dot(normal_row0, normal_os), dot(normal_row1, normal_os), dot(normal_row2, normal_os));
    float cosine = abs(dot(normal, away_ws)) * inversesqrt(max(dot(normal, normal), 1e-30));
    position_rel += (shift_m.x + shift_m.y * max(1.0 - cosine, 0.0)) * away_ws;
#endif
    gl_Position = clip_from_relative * vec4(position_rel, 1.0);
#ifdef MASKED
    pass_base_colour();
#endif
}
