// Object and triangle numbers of each pixel.
#include "lib/alpha.glsl"

layout(location = 0) out uvec2 ids_out;  // 1 + object number, triangle within its draw

void main() {
    discard_masked();
    ids_out = uvec2(uint(surface.w) + 1u, uint(gl_PrimitiveID));
}
