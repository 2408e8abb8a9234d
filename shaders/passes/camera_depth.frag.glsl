// Depth pass of the camera: the rasteriser writes depth, and there is no colour.
#include "lib/alpha.glsl"

void main() { discard_masked(); }
