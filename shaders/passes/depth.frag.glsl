#ifdef MASKED
#include "lib/alpha.glsl"
#endif
#if MAP_IS_COLOUR
layout(location = 0) out float stored_out;
#endif
#if MAP_HOLDS_DISTANCES
uniform vec4 curve;  // near, far, 1 perspective, 1 reversed: near at 1
#endif

void main() {
#ifdef MASKED
    if (masked_out()) discard;
#endif
#if DROPS_STRAYS
    // Seen edge-on a triangle covers texels by rounding alone, with depths of its plane from far beyond it.
    if (abs(gl_FragCoord.z - 0.5) > 0.50001) discard;
#endif
#if MAP_IS_COLOUR
    stored_out = clamp(gl_FragCoord.z, 0.0, 1.0);  // as a depth buffer does
#endif
#if MAP_HOLDS_DISTANCES
    // 1 / w is what the rasteriser interpolates: of a depth the far part of the range would have lost its last bits.
    float z = 1.0 / gl_FragCoord.w;
    // What a near plane flattens lies before it.
    if (curve.z > 0.5) stored_out = clamp((curve.w > 0.5 ? curve.y - z : z - curve.x) / (curve.y - curve.x), 0.0, 1.0);
#endif
}
