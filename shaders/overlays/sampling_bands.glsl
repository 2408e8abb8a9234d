// Texels per pixel along the sparsest direction, in whole powers of two towards 0: below zero under-sampled, above zero
// over-sampled in every direction.
#include "lib/texel_density.glsl"

vec4 overlay(Receiver r) {
    if (r.where >= BEHIND) return vec4(NOTHING);
    return vec4(trunc(log2(texels_per_pixel(r).y)));
}
