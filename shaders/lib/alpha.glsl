// Base colour and alpha mask, the same in every pass.
layout(binding = 2) uniform sampler2D base_colour_map;
in vec2 uv;
in vec4 colour;
flat in vec4 surface;

vec4 base_colour() {
#ifdef TEXTURED
    return colour * texture(base_colour_map, uv);
#else
    return colour;
#endif
}

bool masked_out() { return base_colour().a < surface.y; }
