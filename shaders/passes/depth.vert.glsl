// Depth pass of the light: positions, and uv for masked materials.
#ifdef MASKED
#include "lib/vertex_colour.glsl"
#endif
layout(location = 0) in vec3 position_os;
layout(location = 4) in vec4 row0;
layout(location = 5) in vec4 row1;
layout(location = 6) in vec4 row2;

uniform mat4 clip_from_relative;

void main() {
    vec4 p = vec4(position_os, 1.0);
    gl_Position = clip_from_relative * vec4(dot(row0, p), dot(row1, p), dot(row2, p), 1.0);
#ifdef MASKED
    pass_base_colour();
#endif
}
