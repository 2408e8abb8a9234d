// The camera's depth alone; nothing is written but what the rasteriser writes.
#ifdef MASKED
#include "lib/alpha.glsl"
#endif

void main() {
#ifdef MASKED
    if (masked_out()) discard;
#endif
}
