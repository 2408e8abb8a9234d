// Shadow texels that one pixel spans along its widest direction. Above 1 the map is finer than the picture there.
#include "lib/texel_density.glsl"

vec4 overlay(Receiver r) {
    if (r.where >= BEHIND) return vec4(NOTHING);
    return vec4(texels_per_pixel(r).x);
}
