#ifdef MASKED
#include "lib/alpha.glsl"
#endif
#if map_format == map_format_colour
layout(location = 0) out float depth_out;
#endif

void main() {
#ifdef MASKED
    if (masked_out()) discard;
#endif
#if map_format == map_format_colour
    depth_out = gl_FragCoord.z;
#endif
}
