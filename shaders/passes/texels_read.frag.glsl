// Run of every pixel's kernel that marks each fetched texel of the map in layer MARK_TEXELS.
#include "lib/seen_surface.glsl"
#include "lib/visibility.glsl"
layout(location = 0) out float nothing_out;

void main() { nothing_out = light_visibility(seen_surface(), LIGHT_INDEX); }
