// Mean and mean square of depths over (2 radius + 1) texels along one axis: first of stored depths along x, then of what
// that leaves along y. Those beyond the map's sides do not count.
#include "shared/units.h"
#include "lib/receiver.glsl"
#include "lib/moments.glsl"
#include "lib/blur_axis.glsl"
layout(location = 0) out vec2 moments_out;
uniform int layer;
uniform vec4 curve;  // near, far, 1 perspective

#if BLUR_COLUMNS
layout(binding = UNIT_BLURRED_ROWS) uniform sampler2D rows;
vec2 moments_at(ivec2 at) { return texelFetch(rows, at, 0).rg; }
#else
vec2 moments_at(ivec2 at) {
    float depth = stored_texel(at, layer);
    float share = share_of_range(depth, curve.x, curve.y, curve.z > 0.5);
    return vec2(share, share * share);
}
#endif

void main() {
    ivec2 centre = ivec2(gl_FragCoord.xy), window = blur_window(centre);
    vec2 sum = vec2(0.0);
    for (int i = window.x; i <= window.y; ++i) sum += moments_at(centre + i * BLUR_AXIS);
    moments_out = sum / float(window.y - window.x + 1);
}
