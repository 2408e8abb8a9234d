// Depth pass of the light: positions, and uv for masked materials.
layout(location = 0) in vec3 position_os;
#ifdef MASKED
layout(location = 2) in vec2 uv_in;
#ifdef VERTEX_COLOURS
layout(location = 3) in vec4 colour_in;
out vec4 colour;
#else
flat out vec4 colour;
#endif
layout(location = 7) in vec4 base_colour_in;
layout(location = 8) in vec4 surface_in;
#ifdef TEXTURED
out vec2 uv;
#endif
flat out vec4 surface;
#endif
layout(location = 4) in vec4 row0;
layout(location = 5) in vec4 row1;
layout(location = 6) in vec4 row2;

uniform mat4 clip_from_relative;

void main() {
    vec4 p = vec4(position_os, 1.0);
    gl_Position = clip_from_relative * vec4(dot(row0, p), dot(row1, p), dot(row2, p), 1.0);
#ifdef MASKED
#ifdef TEXTURED
    uv = uv_in;
#endif
#ifdef VERTEX_COLOURS
    colour = colour_in * base_colour_in;
#else
    colour = base_colour_in;
#endif
    surface = surface_in;
#endif
}
