// Means over any rectangle of the map by summed-area tables, whose texels hold the sum of all before them: sixteen fetches
// for any size. Crow, Summed-Area Tables for Texture Mapping, SIGGRAPH 1984.
#include "lib/moments.glsl"

#if filter_sums == filter_sums_integer
#define SUMS uvec2
#if MAP_LAYERS > 1
layout(binding = UNIT_MOMENTS) uniform usampler2DArray sums_map;
#else
layout(binding = UNIT_MOMENTS) uniform usampler2D sums_map;
#endif
const float SUMS_UNIT = 1.0 / SUMS_ONE;
#else
#define SUMS vec2
layout(binding = UNIT_MOMENTS) uniform MAPS sums_map;
const float SUMS_UNIT = 1.0;
#endif

/// Returns the sum of all texels before a corner, along both axes.
SUMS sum_before(ivec2 corner, int layer) {
    if (any(lessThan(corner, ivec2(1)))) return SUMS(0);
    ivec2 texel = min(corner, MAP_SIDES) - 1;
#ifdef MARK_TEXELS
    map_depth((vec2(texel) + 0.5) / MAP_SIZE, layer);
#endif
    return texelFetch(sums_map, TEXEL_IN_LAYER(texel, layer), 0).rg;
}

/// Returns the mean moments over a rectangle around a place of the map, texels weighted by their covered area.
/// @param size width and height of the rectangle, texels
vec4 summed_moments(Receiver r, vec2 at, vec2 size) {
    vec4 moments;
    if (trial_moments(r, at, moments)) return moments;
    bool beyond = any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0)));
    if (beyond && has_border(r)) return border_moments();
#if map_wrap == map_wrap_repeat
    at = fract(at);
#else
    at = clamp(at, 0.0, 1.0);
#endif
    // Near the map's sides the rectangle shrinks on both sides, so that a plane's mean stays the depth at its middle.
    vec2 count = MAP_SIZE;
    at = clamp(at * count, vec2(0.5), count - 0.5);
    vec2 reach = min(0.5 * size, min(at, count - at)), lo = at - reach, hi = at + reach;
    ivec2 first = ivec2(floor(lo)), last = ivec2(floor(hi));
    vec2 cut = lo - vec2(first), held = hi - vec2(last);
    // Sums relative to the first corner are small, so that wrapped integers give the right difference.
    int xs[3] = int[](first.x + 1, last.x, last.x + 1), ys[3] = int[](first.y + 1, last.y, last.y + 1);
    float wx[3] = float[](-cut.x, 1.0 - held.x, held.x), wy[3] = float[](-cut.y, 1.0 - held.y, held.y);
    SUMS origin = sum_before(first, r.layer);
    vec2 sum = vec2(0.0);
    for (int j = 0; j < 3; ++j) {
        SUMS before = sum_before(ivec2(first.x, ys[j]), r.layer) - origin;
        for (int i = 0; i < 3; ++i)
            sum += wx[i] * wy[j] *
                   vec2(sum_before(ivec2(xs[i], ys[j]), r.layer) - sum_before(ivec2(xs[i], first.y), r.layer) - before);
    }
    return vec4(sum * SUMS_UNIT / (4.0 * reach.x * reach.y), 0.0, 0.0);
}

/// Returns the window in texels: filter.window, widened to the pixel's footprint with filter.footprint.
vec2 summed_window(Receiver r) {
    vec2 size = vec2(filter_window);
#if filter_footprint
    mat2 print = pixel_footprint(r);
    size = max(size, (abs(print[0]) + abs(print[1])) * MAP_SIZE);
#endif
    return clamp(size, vec2(1.0), vec2(float(SUMS_MAX_WINDOW)));
}
