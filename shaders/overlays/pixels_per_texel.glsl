// Pixels that one shadow texel spans along its longest direction in the picture. Above 1 the map's texels show.
#include "lib/texel_density.glsl"

vec4 overlay(Receiver r) {
    if (r.where >= BEHIND) return vec4(NOTHING);
    return vec4(1.0 / texels_per_pixel(r).y);
}
