// Clip level in which a fragment is looked up, with its pages as a checkerboard. With map.virtual only.
#include "lib/pages.glsl"
#include "shared/colours.h"

vec4 overlay(Receiver r) {
#if MAP_PAGED
    if (r.where >= BEHIND) return vec4(0.0);
    ivec2 page = ivec2(floor(r.uvd.xy * float(map_resolution) / float(PAGE_SIZE)));
    float shade = ((page.x + page.y) & 1) == 0 ? 1.0 : 0.72;
    return vec4(view_colour(r.layer - LIGHT_FIRST_VIEW[r.light]) * shade, 1.0);
#else
    return vec4(0.0);
#endif
}
