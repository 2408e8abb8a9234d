// One axis of a box blur of stored depth: the mean of the 2 radius + 1 texels about each that lie in the map.
#if BLUR_COLUMNS
layout(binding = 4) uniform sampler2D rows;  // blurred along x
float stored(ivec2 at) { return texelFetch(rows, at, 0).r; }
#else
#include "lib/shadow_map.glsl"
uniform int layer;
float stored(ivec2 at) {
#if MAP_LAYERS > 1
    return texelFetch(shadow_map, ivec3(at, layer), 0).r;
#else
    return texelFetch(shadow_map, at, 0).r;
#endif
}
#endif
uniform int radius;

#if BLUR_COLUMNS && map_format != map_format_colour
#define TO_DEPTH_BUFFER
#else
layout(location = 0) out float depth_out;
#endif

void main() {
    ivec2 centre = ivec2(gl_FragCoord.xy);
#if BLUR_COLUMNS
    ivec2 axis = ivec2(0, 1);
    int here = centre.y;
#else
    ivec2 axis = ivec2(1, 0);
    int here = centre.x;
#endif
    int first = max(-radius, -here), last = min(radius, map_resolution - 1 - here);
    float sum = 0.0;
    for (int i = first; i <= last; ++i) sum += stored(centre + i * axis);
    float mean = sum / float(last - first + 1);
#ifdef TO_DEPTH_BUFFER
    gl_FragDepth = mean;
#else
    depth_out = mean;
#endif
}
