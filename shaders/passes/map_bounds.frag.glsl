// Least and greatest depth of a map, as stored: of cells of BOUNDS_CELL^2 texels, then of blocks of as many cells and those
// within a kernel's reach, first along x.
#include "lib/shadow_map.glsl"
layout(location = 0) out vec2 bounds_out;
uniform int layer;
uniform int reach;  // cells beside a block

#if BOUNDS_STEP == 0
void main() {
    vec2 corner = floor(gl_FragCoord.xy) * float(BOUNDS_CELL);
    vec2 bounds = vec2(3e38, -3e38);
    for (int y = 1; y < BOUNDS_CELL; y += 2)
        for (int x = 1; x < BOUNDS_CELL; x += 2) {
            // Where four texels meet. Those beyond the map's sides only widen the bounds.
            vec4 four = MAP_GATHER(shadow_map, (corner + vec2(x, y)) / float(map_resolution), layer);
            bounds.x = min(bounds.x, min(min(four.x, four.y), min(four.z, four.w)));
            bounds.y = max(bounds.y, max(max(four.x, four.y), max(four.z, four.w)));
        }
    bounds_out = bounds;
}
#else
layout(binding = UNIT_BLURRED_ROWS) uniform sampler2D finer;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy), size = textureSize(finer, 0);
    int block = BOUNDS_STEP == 1 ? at.x : at.y, cells = BOUNDS_STEP == 1 ? size.x : size.y;
    int first = block * BOUNDS_CELL - reach, last = (block + 1) * BOUNDS_CELL - 1 + reach;
    vec2 bounds = vec2(3e38, -3e38);
    for (int i = max(first, 0); i <= min(last, cells - 1); ++i) {
        vec2 cell = texelFetch(finer, BOUNDS_STEP == 1 ? ivec2(i, at.y) : ivec2(at.x, i), 0).rg;
        bounds = vec2(min(bounds.x, cell.x), max(bounds.y, cell.y));
    }
#if map_wrap == map_wrap_repeat || map_wrap == map_wrap_border
    // Taps beyond the map's sides find what is not here.
    if (first < 0 || last >= cells) bounds = vec2(-3e38, 3e38);
#endif
    bounds_out = bounds;
}
#endif
