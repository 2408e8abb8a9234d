// Visibility of one light as a picture of its own, from its source.
#include "lib/surface.glsl"
#include "lib/visibility.glsl"

#include SOURCE_FILE

layout(location = 0) out float visibility_out;

void main() {
#ifdef MASKED
    if (masked_out()) discard;
#endif
    Surface s = make_surface();
    // Seen edge-on a triangle covers a pixel by rounding alone, and a rasteriser may find no place for it: then lit.
    vec3 far = abs(s.position);
    bool somewhere = far.x + far.y + far.z < 1e30;
    visibility_out = somewhere ? source_visibility(s, LIGHT_INDEX) : 1.0;
}
