// Depth pass of the camera: the rasteriser writes depth, and there is no colour.
#ifdef MASKED
#include "lib/alpha.glsl"
#endif

void main() {
#ifdef MASKED
    if (masked_out()) discard;
#endif
}
