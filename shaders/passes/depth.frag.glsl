// Depth pass of the light: stored depth or distance of colour formats, and the alpha mask.
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
    discard_masked();
#endif
#if DROPS_STRAYS
    // A triangle edge-on to the light covers texels by rounding alone, with depths of its plane far outside the triangle.
    if (abs(gl_FragCoord.z - 0.5) > 0.50001) discard;
#endif
#if MAP_IS_COLOUR
    stored_out = clamp(gl_FragCoord.z, 0.0, 1.0);  // same range as a depth buffer
#endif
#if MAP_HOLDS_DISTANCES
    // The rasteriser interpolates 1 / w exactly. Depth would lose its last bits in the far part of the range.
    float z = 1.0 / gl_FragCoord.w;
    // Flattened casters (near plane) are before the range and are clamped.
    if (curve.z > 0.5) stored_out = clamp((curve.w > 0.5 ? curve.y - z : z - curve.x) / (curve.y - curve.x), 0.0, 1.0);
#endif
}
