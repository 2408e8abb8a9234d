// Runs the kernel of every pixel, which marks each texel that it fetches from the map of layer MARK_TEXELS.
#include "lib/seen_surface.glsl"
#include "lib/visibility.glsl"
layout(location = 0) out float nothing_out;

void main() { nothing_out = light_visibility(seen_surface(), LIGHT_INDEX); }
