// Smallest and largest drawn depth of one block of a depth image. The clear value (far plane) is left out.
#include "lib/depth.glsl"
#include "lib/shown_depth.glsl"
uniform ivec2 blocks;
layout(location = 0) out vec2 range_out;

void main() {
    ivec2 size = shown_size(), block = ivec2(gl_FragCoord.xy);
    ivec2 first = block * size / blocks, last = (block + 1) * size / blocks;
    float empty = curve.w > 0.5 ? 0.0 : 1.0;
    vec2 range = vec2(3e38, -3e38);  // nothing drawn
    for (int y = first.y; y < last.y; ++y)
        for (int x = first.x; x < last.x; ++x) {
            float d = shown_depth(ivec2(x, y));
#ifdef FROM_CHANNEL
            bool drawn = !isnan(d);
#else
            bool drawn = d != empty && !isnan(d);
#endif
            if (drawn) range = vec2(min(range.x, d), max(range.y, d));
        }
    range_out = range;
}
