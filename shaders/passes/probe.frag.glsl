// One pixel's surface and visibility as numbers.
#include "lib/surface.glsl"
#include "lib/visibility.glsl"

layout(location = 0) out vec4 position_out;   // xyz relative, w: 1 + object number
layout(location = 1) out vec4 geometric_out;  // xyz, w: receives
layout(location = 2) out vec4 shading_out;    // xyz
layout(location = 3) out vec4 visibility_out; // x, yzw: vertex normal

void main() {
#ifdef MASKED
    if (masked_out()) discard;
#endif
    Surface s = make_surface();
    position_out = vec4(s.position, 1.0 + surface.w);
    geometric_out = vec4(s.geometric, surface.x);
    shading_out = vec4(s.shading, 0.0);
    visibility_out = vec4(light_visibility(s, LIGHT_INDEX), s.vertex);
}
