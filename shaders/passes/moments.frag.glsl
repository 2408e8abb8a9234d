// Mean and mean square of depths over (2 radius + 1) texels along one axis: first of stored depths along x, then of what
// that leaves along y. Those beyond the map's sides do not count.
#include "lib/receiver.glsl"
#include "lib/moments.glsl"
layout(location = 0) out vec2 moments_out;
uniform int layer, radius;
uniform vec4 curve;  // near, far, 1 perspective

#if MOMENTS_COLUMNS
layout(binding = 4) uniform sampler2D rows;
vec2 moments_at(ivec2 at) { return texelFetch(rows, at, 0).rg; }
#else
vec2 moments_at(ivec2 at) {
#if MAP_LAYERS > 1
    float depth = texelFetch(shadow_map, ivec3(at, layer), 0).r;
#else
    float depth = texelFetch(shadow_map, at, 0).r;
#endif
    float share = share_of_range(depth, curve.x, curve.y, curve.z > 0.5);
    return vec2(share, share * share);
}
#endif

void main() {
    ivec2 centre = ivec2(gl_FragCoord.xy);
#if MOMENTS_COLUMNS
    ivec2 axis = ivec2(0, 1);
    int here = centre.y;
#else
    ivec2 axis = ivec2(1, 0);
    int here = centre.x;
#endif
    int first = max(-radius, -here), last = min(radius, map_resolution - 1 - here);
    vec2 sum = vec2(0.0);
    for (int i = first; i <= last; ++i) sum += moments_at(centre + i * axis);
    moments_out = sum / float(last - first + 1);
}
