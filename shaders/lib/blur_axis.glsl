// One axis of a blur over texels of a map, without texels outside the map.
#ifdef BLUR_RADIUS
const int radius = BLUR_RADIUS;  // constant, so that loops unroll
#else
uniform int radius;
#endif
#if BLUR_COLUMNS
const ivec2 BLUR_AXIS = ivec2(0, 1);
#else
const ivec2 BLUR_AXIS = ivec2(1, 0);
#endif

/// Returns the first and last offset along the axis from a texel to its window, inside the map.
ivec2 blur_window(ivec2 texel) {
    int here = texel.x * BLUR_AXIS.x + texel.y * BLUR_AXIS.y;
    return ivec2(max(-radius, -here), min(radius, MAP_SIDES.x * BLUR_AXIS.x + MAP_SIDES.y * BLUR_AXIS.y - 1 - here));
}
