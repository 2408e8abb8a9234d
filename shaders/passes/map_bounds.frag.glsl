// Bounds of a map's stored depths by two parallel planes, first of cells of BOUNDS_CELL^2 texels, then of blocks of as many
// cells with all cells in a kernel's reach. Planes are tighter than a nearest and farthest depth, since the depths of one
// surface form a slope.
#include "lib/shadow_map.glsl"
layout(location = 0) out vec4 bounds_out;  // xy: slope per texel; zw: depths of both planes at the middle (lib/map_bounds.glsl)
uniform int layer;
uniform int reach;  // cells around a block that a kernel reaches

/// Returns the bounds with the smaller range.
vec4 tighter(vec4 a, vec4 b) { return a.w - a.z < b.w - b.z ? a : b; }

#if BOUNDS_STEP == 0
float least(vec4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }
float greatest(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

void main() {
    vec2 corner = floor(gl_FragCoord.xy) * float(BOUNDS_CELL);
    // textureGather order: x and y are the upper texels, w and z the lower, each from the left.
    vec4 four[4];
    vec2 slope = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        vec2 half_of = vec2(i & 1, i >> 1);
        // The gather is at the common corner of four texels. Texels outside the map only widen the bounds.
        four[i] = MAP_GATHER(shadow_map, (corner + 1.0 + 2.0 * half_of) / MAP_SIZE, layer);
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
    // The slope of the middle cell is used for the block if it gives tighter bounds than a level plane.
    vec2 slope = texelFetch(cells, min(block * BOUNDS_CELL + half_block, last_cell), 0).xy;
    vec4 sloped = vec4(slope, 3e38, -3e38), level = vec4(0.0, 0.0, 3e38, -3e38);
    const float side = 0.5 * float(BOUNDS_CELL - 1);  // distance from a cell's middle to the centres of its outer texels
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
    // Taps outside the map may read depths that are not in the bounds.
    if (any(lessThan(first, ivec2(0))) || any(greaterThan(last, last_cell))) bounds_out = vec4(0.0, 0.0, -3e38, 3e38);
#endif
}
#endif
