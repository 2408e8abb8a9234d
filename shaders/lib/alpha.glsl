// Base colour and alpha mask, shared by all passes.
#include "shared/units.h"
layout(binding = UNIT_BASE_COLOUR) uniform sampler2D base_colour_map;
#ifdef TEXTURED
in vec2 uv;
#endif
#ifdef VERTEX_COLOURS
in vec4 colour;
#else
flat in vec4 colour;
#endif
#ifdef SURFACE_FLAGS
flat in vec4 surface;  // x: receives shadows, y: alpha cutoff, z: unlit, w: object number
#endif

vec4 base_colour() {
#ifdef TEXTURED
    return colour * texture(base_colour_map, uv);
#else
    return colour;
#endif
}

/// Drops the fragment where the alpha mask cuts it out.
void discard_masked() {
#ifdef MASKED
    if (base_colour().a < surface.y) discard;
#endif
}
