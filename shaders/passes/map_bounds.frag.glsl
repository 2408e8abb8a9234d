// Between which two parallel planes a map's depths lie, as stored: of cells of BOUNDS_CELL^2 texels, then of blocks of as
// many cells and those within a kernel's reach. Depths of one surface lie on a plane, of which a nearest and a farthest
// depth would hold the slope too.
#include "lib/shadow_map.glsl"
layout(location = 0) out vec4 bounds_out;  // slope along x and y a texel, least and greatest rest: see lib/map_bounds.glsl
uniform int layer;
uniform int reach;  // cells beside a block

/// Of two planes the one that leaves less.
vec4 tighter(vec4 a, vec4 b) { return a.w - a.z < b.w - b.z ? a : b; }

#if BOUNDS_STEP == 0
float least(vec4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }
float greatest(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

void main() {
    vec2 corner = floor(gl_FragCoord.xy) * float(BOUNDS_CELL);
    // In textureGather's order: x and y above, w and z below, each from the left.
    vec4 four[4];
    vec2 slope = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        vec2 half_of = vec2(i & 1, i >> 1);
        // Where four texels meet. Those beyond the map's sides only widen the bounds.
        four[i] = MAP_GATHER(shadow_map, (corner + 1.0 + 2.0 * half_of) / float(map_resolution), layer);
        slope += dot(four[i], vec4(1.0)) * (half_of - 0.5) / 8.0;
    }
    vec4 sloped = vec4(slope, 3e38, -3e38), level = vec4(0.0, 0.0, 3e38, -3e38);
    for (int i = 0; i < 4; ++i) {
        vec2 middle = 2.0 * vec2(i & 1, i >> 1) - 1.0;
        vec4 rest = four[i] - slope.x * (middle.x + vec4(-0.5, 0.5, 0.5, -0.5)) -
                    slope.y * (middle.y + vec4(0.5, 0.5, -0.5, -0.5));
        sloped.zw = vec2(min(sloped.z, least(rest)), max(sloped.w, greatest(rest)));
        level.zw = vec2(min(level.z, least(four[i])), max(level.w, greatest(four[i])));
    }
    bounds_out = tighter(sloped, level);
}
#else
layout(binding = UNIT_BLURRED_ROWS) uniform sampler2D cells;

void main() {
    ivec2 block = ivec2(gl_FragCoord.xy), last_cell = textureSize(cells, 0) - 1;
    ivec2 first = block * BOUNDS_CELL - reach, last = (block + 1) * BOUNDS_CELL - 1 + reach;
    const int half_block = BOUNDS_CELL / 2;
    // The plane of a cell in the middle stands for all where that leaves less than none.
    vec2 slope = texelFetch(cells, min(block * BOUNDS_CELL + half_block, last_cell), 0).xy;
    vec4 sloped = vec4(slope, 3e38, -3e38), level = vec4(0.0, 0.0, 3e38, -3e38);
    const float side = 0.5 * float(BOUNDS_CELL - 1);  // from a cell's middle to its outer texels'
    for (int y = max(first.y, 0); y <= min(last.y, last_cell.y); ++y)
        for (int x = max(first.x, 0); x <= min(last.x, last_cell.x); ++x) {
            vec4 cell = texelFetch(cells, ivec2(x, y), 0);
            vec2 off = (vec2(ivec2(x, y) - block * BOUNDS_CELL - half_block) + 0.5) * float(BOUNDS_CELL);
            vec2 steeper = abs(cell.xy - slope);
            vec2 rest = cell.zw - dot(slope, off) + vec2(-side, side) * (steeper.x + steeper.y);
            sloped.zw = vec2(min(sloped.z, rest.x), max(sloped.w, rest.y));
            rest = cell.zw + vec2(-side, side) * (abs(cell.x) + abs(cell.y));
            level.zw = vec2(min(level.z, rest.x), max(level.w, rest.y));
        }
    bounds_out = tighter(sloped, level);
#if map_wrap == map_wrap_repeat || map_wrap == map_wrap_border
    // Taps beyond the map's sides find what is not here.
    if (any(lessThan(first, ivec2(0))) || any(greaterThan(last, last_cell))) bounds_out = vec4(0.0, 0.0, -3e38, 3e38);
#endif
}
#endif
