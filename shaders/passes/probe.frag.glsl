// Surface and visibility of one pixel, as numbers for the probe.
#include "lib/surface.glsl"
#include "lib/visibility.glsl"

layout(location = 0) out vec4 position_out;   // xyz relative, w: 1 + object number
layout(location = 1) out vec4 geometric_out;  // xyz, w: receives, plus 2 if in the map, plus 4 x the low 16 bits of the triangle's number
layout(location = 2) out vec4 shading_out;    // xyz, w: the high 16 bits, as floats hold whole numbers up to 2^24
layout(location = 3) out vec4 visibility_out; // x, yzw: vertex normal

void main() {
    discard_masked();
    Surface s = make_surface();
    position_out = vec4(s.position, 1.0 + surface.w);
    uint triangle = uint(gl_PrimitiveID);
    geometric_out = vec4(s.geometric, float((triangle & 0xffffu) * 4u + (s.in_map ? 2u : 0u) + (surface.x > 0.5 ? 1u : 0u)));
    shading_out = vec4(s.shading, float(triangle >> 16));
    visibility_out = vec4(light_visibility(s, LIGHT_INDEX), s.vertex);
}
