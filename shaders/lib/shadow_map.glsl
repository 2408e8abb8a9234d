// Access to shadow maps. One map is a plain texture, several are the layers of an array.
#include "shared/units.h"
#include "lib/depth.glsl"
#include "lib/frame.glsl"
#include "lib/pages.glsl"
#if MAP_PAGED
#define MAPS sampler2D
float sampler_compare(vec2 at, int layer, float own) { return 0.0; }  // compared by hand
#define MAP_AT(map, at, layer) paged_depth_at(map, at, layer)
#define MAP_GATHER(map, at, layer) paged_gather(map, at, layer)
#define MAP_TEXEL(map, texel, layer) paged_texel(map, texel, layer)
#elif MAP_LAYERS > 1
#define MAPS sampler2DArray
layout(binding = UNIT_SHADOW_MAP_COMPARE) uniform sampler2DArrayShadow shadow_map_compare; // comparison by map_compare
float sampler_compare(vec2 at, int layer, float own) { return texture(shadow_map_compare, vec4(at, layer, own)); }
#define IN_LAYER(at, layer) vec3(at, layer)
#define TEXEL_IN_LAYER(texel, layer) ivec3(texel, layer)
#else
#define MAPS sampler2D
layout(binding = UNIT_SHADOW_MAP_COMPARE) uniform sampler2DShadow shadow_map_compare;
float sampler_compare(vec2 at, int layer, float own) { return texture(shadow_map_compare, vec3(at, own)); }
#define IN_LAYER(at, layer) at
#define TEXEL_IN_LAYER(texel, layer) texel
#endif
#if !MAP_PAGED
#define MAP_AT(map, at, layer) texture(map, IN_LAYER(at, layer)).r
#define MAP_GATHER(map, at, layer) textureGather(map, IN_LAYER(at, layer))
#define MAP_TEXEL(map, texel, layer) texelFetch(map, TEXEL_IN_LAYER(texel, layer), 0).r
#endif
layout(binding = UNIT_SHADOW_MAP) uniform MAPS shadow_map;  // nearest, no comparison

#if MAP_HOLDS_DISTANCES
/// Converts stored shares of a view's range to depths; DepthCurve::depth_at_fraction().
vec4 depth_of_stored(vec4 share, int layer) {
    ViewBlock view = view_of(layer);
    if (!is_perspective(view)) return share;
    float near = view.curve.x, far = view.curve.y;
    // Both ends, and texels without a page, stay as stored.
    bvec4 between = bvec4(ivec4(greaterThan(share, vec4(0.0))) * ivec4(lessThan(share, vec4(1.0))));
#if map_reversed_z
    return mix(share, near * share / (far - share * (far - near)), between);
#else
    return mix(share, far * share / (near + share * (far - near)), between);
#endif
}
#else
vec4 depth_of_stored(vec4 depth, int layer) { return depth; }
#endif
float depth_of_stored(float stored, int layer) { return depth_of_stored(vec4(stored), layer).x; }

/// Returns a texel as stored.
float raw_texel(ivec2 texel, int layer) { return MAP_TEXEL(shadow_map, texel, layer); }
float stored_texel(ivec2 texel, int layer) { return depth_of_stored(raw_texel(texel, layer), layer); }
float stored_depth(vec2 at, int layer) { return depth_of_stored(MAP_AT(shadow_map, at, layer), layer); }
vec4 stored_gather(vec2 at, int layer) { return depth_of_stored(MAP_GATHER(shadow_map, at, layer), layer); }

/// Returns a depth that every comparison finds lit, or dark.
float depth_of(bool lit) { return lit == (map_reversed_z == 0) ? 3e38 : -3e38; }

#ifdef MAP_TRIALS
// Trials run the same kernels on the unfiltered map, or with a fixed visibility for taps outside the map.
layout(binding = UNIT_UNFILTERED_MAP) uniform MAPS unfiltered_map;
bool map_is_unfiltered = false;
float beyond_answer = -1.0;  // visibility of taps outside the map; below 0: by map.wrap

vec4 with_trial_answer(vec4 depth, vec4 u, vec4 v) {
#if !SEAM_TRIALS
    return depth;
#endif
    if (beyond_answer < 0.0) return depth;
    // A depth beyond all others gives the wanted comparison.
    float always = depth_of(beyond_answer > 0.5);
    bvec4 inside = bvec4(ivec4(greaterThanEqual(u, vec4(0.0))) * ivec4(lessThanEqual(u, vec4(1.0))) *
                         ivec4(greaterThanEqual(v, vec4(0.0))) * ivec4(lessThanEqual(v, vec4(1.0))));
    return mix(vec4(always), depth, inside);
}

float map_depth(vec2 at, int layer) {
    float depth =
        map_is_unfiltered ? depth_of_stored(MAP_AT(unfiltered_map, at, layer), layer) : stored_depth(at, layer);
    return with_trial_answer(vec4(depth), at.xxxx, at.yyyy).x;
}

/// Returns four depths in textureGather order.
/// @param at common corner of four texels
vec4 map_gather(vec2 at, int layer) {
    vec4 depth =
        map_is_unfiltered ? depth_of_stored(MAP_GATHER(unfiltered_map, at, layer), layer) : stored_gather(at, layer);
    vec2 half_texel = 0.5 / MAP_SIZE;
    vec4 u = at.x + vec4(-1.0, 1.0, 1.0, -1.0) * half_texel.x, v = at.y + vec4(1.0, 1.0, -1.0, -1.0) * half_texel.y;
    return with_trial_answer(depth, u, v);
}
#elif defined(RECORD_TAPS)
// Record of one texel that a kernel reads. The kernel's result, with this texel alone lit, is the texel's weight.
int tap_wanted = 0, taps_read = 0;
vec3 tap_found = vec3(0.0);  // texel, stored depth

float record_tap(vec2 texel, float stored) {
    bool wanted = taps_read++ == tap_wanted;
    if (wanted) tap_found = vec3(texel, stored);
    return depth_of(wanted);
}

float map_depth(vec2 at, int layer) { return record_tap(floor(at * MAP_SIZE), stored_depth(at, layer)); }

vec4 map_gather(vec2 at, int layer) {
    vec2 texel = round(at * MAP_SIZE) - 1.0;
    vec4 stored = stored_gather(at, layer);
    stored.x = record_tap(texel + vec2(0.0, 1.0), stored.x);
    stored.y = record_tap(texel + vec2(1.0, 1.0), stored.y);
    stored.z = record_tap(texel + vec2(1.0, 0.0), stored.z);
    stored.w = record_tap(texel, stored.w);
    return stored;
}
#elif defined(MARK_TEXELS)
layout(binding = IMAGE_TEXELS_READ, r32f) uniform writeonly image2D texels_read;

void mark_texel(vec2 texel, int layer) {
    ivec2 at;
    if (layer == MARK_TEXELS && wrapped_texel(texel, at)) imageStore(texels_read, at, vec4(1.0));
}

float map_depth(vec2 at, int layer) {
    mark_texel(floor(at * MAP_SIZE), layer);
    return stored_depth(at, layer);
}

vec4 map_gather(vec2 at, int layer) {
    vec2 texel = round(at * MAP_SIZE) - 1.0;
    for (int i = 0; i < 4; ++i) mark_texel(texel + vec2(i & 1, i >> 1), layer);
    return stored_gather(at, layer);
}
#else
float map_depth(vec2 at, int layer) { return stored_depth(at, layer); }
vec4 map_gather(vec2 at, int layer) { return stored_gather(at, layer); }
#endif

/// Returns a stored depth of a blocker search, which is not compared and not recorded as a tap.
float searched_depth(vec2 at, int layer) {
#ifdef RECORD_TAPS
    return stored_depth(at, layer);
#else
    return map_depth(at, layer);
#endif
}

/// Returns one comparison as by the kernel's shadow sampler: with the nearest texel, or bilinear over 2x2 texels.
float map_compare_at(vec2 at, int layer, float own) {
#if !COMPARE_BY_HAND
    return sampler_compare(at, layer, own);
#elif SAMPLER_BILINEAR
    vec2 between = at * MAP_SIZE - 0.5, texel = floor(between), f = between - texel;
    vec4 lit = depth_test(own, map_gather((texel + 1.0) / MAP_SIZE, layer));
    return mix(mix(lit.w, lit.z, f.x), mix(lit.x, lit.y, f.x), f.y);
#else
    return depth_test(own, map_depth(at, layer));
#endif
}
