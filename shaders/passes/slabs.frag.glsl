// Translucent quad of one texel with a thin outline. Blue: stored depth; orange: moved by the bias.
in vec2 within;
flat in float biased;
uniform float strength;  // opacity factor: 1 for visible quads, less for hidden ones
layout(location = 0) out vec4 colour_out;

const float FILL = 0.42, OUTLINE = 0.95, OUTLINE_PIXELS = 1.1;

void main() {
    vec3 colour = biased > 0.5 ? vec3(0.96, 0.56, 0.16) : vec3(0.20, 0.52, 0.96);
    vec2 pixel = max(fwidth(within), vec2(1e-6));  // of the slab, per axis
    vec2 inside = min(within, 1.0 - within) / pixel;
    float line = 1.0 - smoothstep(OUTLINE_PIXELS - 0.5, OUTLINE_PIXELS + 0.5, min(inside.x, inside.y));
    // Quads of a few pixels get no outline.
    line *= 1.0 - smoothstep(0.12, 0.35, max(pixel.x, pixel.y));
    colour_out = vec4(mix(colour, colour * 0.55, line), strength * mix(FILL, OUTLINE, line));
}
