// The overlay through its colour scale over the shaded picture.
#include "shared/units.h"
#include "lib/colour_scale.glsl"
layout(binding = UNIT_SHADED) uniform sampler2D shaded;
layout(binding = UNIT_OVERLAY_VALUES) uniform sampler2D overlay_values;
uniform vec4 scale;  // min, max, opacity, 1 diverging
uniform int scalar;
uniform int grey;  // the picture under the overlay loses its colours, so that those of the overlay stand out
layout(location = 0) out vec4 colour_out;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 under = texelFetch(shaded, at, 0), value = texelFetch(overlay_values, at, 0);
    // Rec. 709 weights on encoded values: a backdrop, not a measurement (as artefact_picture() has it).
    if (grey != 0) under.rgb = vec3(40.0 / 255.0 + 0.7 * dot(under.rgb, vec3(0.2126, 0.7152, 0.0722)));
    vec3 colour = value.rgb;
    float opacity = min(value.a, 1.0) * scale.z;  // counts add up alpha too
    if (scalar != 0) {
        float t = (value.x - scale.x) / max(scale.y - scale.x, 1e-30);
        colour = scale.w > 0.5 ? diverging_colour(t) : sequential_colour(t);
        // No value (the fragment has none for this overlay): the picture stays, darkened.
        if (isnan(value.x)) colour = vec3(0.06);
    }
    colour_out = vec4(mix(under.rgb, clamp(colour, 0.0, 1.0), opacity), 1.0);
}
