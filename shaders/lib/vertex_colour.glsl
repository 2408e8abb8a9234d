// Attributes of base colour and alpha mask in vertex shaders, and their outputs for lib/alpha.glsl.
layout(location = 2) in vec2 uv_in;
#ifdef VERTEX_COLOURS
layout(location = 3) in vec4 colour_in;
out vec4 colour;
#else
flat out vec4 colour;
#endif
layout(location = 7) in vec4 base_colour_in;
layout(location = 8) in vec4 surface_in;  // x: receives shadows, y: alpha cutoff, z: unlit, w: object number
#ifdef TEXTURED
out vec2 uv;
#endif
#ifdef SURFACE_FLAGS
flat out vec4 surface;
#endif

/// Passes base colour, texture coordinates and flags to the fragment shader.
void pass_base_colour() {
#ifdef TEXTURED
    uv = uv_in;
#endif
#ifdef VERTEX_COLOURS
    colour = colour_in * base_colour_in;
#else
    colour = base_colour_in;
#endif
#ifdef SURFACE_FLAGS
    surface = surface_in;
#endif
}
