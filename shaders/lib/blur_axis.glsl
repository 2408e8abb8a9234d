// One axis of a blur over texels of a map, those beyond its sides left out.
#ifdef BLUR_RADIUS
const int radius = BLUR_RADIUS;  // known, so that loops over it unroll
#else
uniform int radius;
#endif
#if BLUR_COLUMNS
const ivec2 BLUR_AXIS = ivec2(0, 1);
#else
const ivec2 BLUR_AXIS = ivec2(1, 0);
#endif

/// First and last step along the axis from a texel to those that count.
ivec2 blur_window(ivec2 texel) {
    int here = texel.x * BLUR_AXIS.x + texel.y * BLUR_AXIS.y;
    return ivec2(max(-radius, -here), min(radius, map_resolution - 1 - here));
}
