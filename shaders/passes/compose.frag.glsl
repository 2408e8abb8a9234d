// Blend of the overlay, coloured by its scale, over the shaded picture.
#include "shared/units.h"
#include "lib/colour_scale.glsl"
layout(binding = UNIT_SHADED) uniform sampler2D shaded;
layout(binding = UNIT_OVERLAY_VALUES) uniform sampler2D overlay_values;
uniform vec4 scale;  // min, max, opacity, 1 diverging
uniform int scalar;
uniform int grey;  // 1: the picture below turns grey, so that the overlay's colours stand out
uniform int tint;  // 1: the overlay is darkened where the picture is dark
layout(location = 0) out vec4 colour_out;

// Brightness of the picture at which an overlay keeps its colours, the share of them that is left in black, and the
// brightness of the picture up to which that share holds.
const float LIT = 0.5, DARKEST = 0.42, DARK = 0.08;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 under = texelFetch(shaded, at, 0), value = texelFetch(overlay_values, at, 0);
    // Rec. 709 weights on encoded values are enough for a backdrop, as in artefact_picture().
    float bright = dot(under.rgb, vec3(0.2126, 0.7152, 0.0722));
    if (grey != 0) under.rgb = vec3(40.0 / 255.0 + 0.7 * bright);
    vec3 colour = value.rgb;
    float opacity = min(value.a, 1.0) * scale.z;  // counts add up alpha too
    if (scalar != 0) {
        float t = (value.x - scale.x) / max(scale.y - scale.x, 1e-30);
        colour = scale.w > 0.5 ? diverging_colour(t) : sequential_colour(t);
        // Fragments without a value are darkened.
        if (isnan(value.x)) colour = vec3(0.06);
    }
    if (tint != 0) colour = clamp(colour, 0.0, 1.0) * mix(DARKEST, 1.0, smoothstep(DARK, LIT, bright));
    colour_out = vec4(mix(under.rgb, clamp(colour, 0.0, 1.0), opacity), 1.0);
}
