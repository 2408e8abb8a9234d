// One axis of a box blur of stored depth: the mean of the 2 radius + 1 texels around each, without those outside the map.
#include "shared/units.h"
#if BLUR_COLUMNS
layout(binding = UNIT_BLURRED_ROWS) uniform sampler2D rows;  // blurred along x
float stored(ivec2 at) { return texelFetch(rows, at, 0).r; }
#else
#include "lib/shadow_map.glsl"
uniform int layer;
float stored(ivec2 at) { return raw_texel(at, layer); }
#endif
#include "lib/blur_axis.glsl"

#if BLUR_COLUMNS && !MAP_IS_COLOUR
#define TO_DEPTH_BUFFER
#else
layout(location = 0) out float depth_out;
#endif

void main() {
    ivec2 centre = ivec2(gl_FragCoord.xy), window = blur_window(centre);
    float sum = 0.0;
    for (int i = window.x; i <= window.y; ++i) sum += stored(centre + i * BLUR_AXIS);
    float mean = sum / float(window.y - window.x + 1);
#ifdef TO_DEPTH_BUFFER
    gl_FragDepth = mean;
#else
    depth_out = mean;
#endif
}
