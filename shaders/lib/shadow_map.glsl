// The shadow maps: one picture is a plain texture, several are the layers of an array.
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
layout(binding = UNIT_SHADOW_MAP_COMPARE) uniform sampler2DArrayShadow shadow_map_compare; // comparison as map_compare has it
float sampler_compare(vec2 at, int layer, float own) { return texture(shadow_map_compare, vec4(at, layer, own)); }
#define IN_LAYER(at, layer) vec3(at, layer)
#define MAP_TEXEL(map, texel, layer) texelFetch(map, ivec3(texel, layer), 0).r
#else
#define MAPS sampler2D
layout(binding = UNIT_SHADOW_MAP_COMPARE) uniform sampler2DShadow shadow_map_compare;
float sampler_compare(vec2 at, int layer, float own) { return texture(shadow_map_compare, vec3(at, own)); }
#define IN_LAYER(at, layer) at
#define MAP_TEXEL(map, texel, layer) texelFetch(map, texel, 0).r
#endif
#if !MAP_PAGED
#define MAP_AT(map, at, layer) texture(map, IN_LAYER(at, layer)).r
#define MAP_GATHER(map, at, layer) textureGather(map, IN_LAYER(at, layer))
#endif
layout(binding = UNIT_SHADOW_MAP) uniform MAPS shadow_map;  // nearest, no comparison

#if MAP_HOLDS_DISTANCES
/// Depths of stored shares of a view's range: see DepthCurve::depth_at_fraction().
vec4 depth_of_stored(vec4 share, int layer) {
    ViewBlock view = view_of(layer);
    if (!is_perspective(view)) return share;
    float near = view.curve.x, far = view.curve.y;
    // As stored at both ends, and where there is no page.
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

/// A texel as it is stored.
float kept_texel(ivec2 texel, int layer) { return MAP_TEXEL(shadow_map, texel, layer); }
float stored_texel(ivec2 texel, int layer) { return depth_of_stored(kept_texel(texel, layer), layer); }
float stored_depth(vec2 at, int layer) { return depth_of_stored(MAP_AT(shadow_map, at, layer), layer); }
vec4 stored_gather(vec2 at, int layer) { return depth_of_stored(MAP_GATHER(shadow_map, at, layer), layer); }

/// A depth that every comparison finds lit, or dark.
float depth_of(bool lit) { return lit == (map_reversed_z == 0) ? 3e38 : -3e38; }

#ifdef MAP_TRIALS
// The same kernels on another map, and with an answer in place of what lies beyond the map's sides.
layout(binding = UNIT_UNFILTERED_MAP) uniform MAPS unfiltered_map;
bool map_is_unfiltered = false;
float beyond_answer = -1.0;  // visibility of taps beyond the sides; below 0: as map.wrap has it

vec4 answered(vec4 depth, vec4 u, vec4 v) {
#if !SEAM_TRIALS
    return depth;
#endif
    if (beyond_answer < 0.0) return depth;
    // Beyond every depth on the side that answers.
    float always = depth_of(beyond_answer > 0.5);
    bvec4 inside = bvec4(ivec4(greaterThanEqual(u, vec4(0.0))) * ivec4(lessThanEqual(u, vec4(1.0))) *
                         ivec4(greaterThanEqual(v, vec4(0.0))) * ivec4(lessThanEqual(v, vec4(1.0))));
    return mix(vec4(always), depth, inside);
}

float map_depth(vec2 at, int layer) {
    float depth =
        map_is_unfiltered ? depth_of_stored(MAP_AT(unfiltered_map, at, layer), layer) : stored_depth(at, layer);
    return answered(vec4(depth), at.xxxx, at.yyyy).x;
}

/// @param at where four texels meet
vec4 map_gather(vec2 at, int layer) {
    vec4 depth =
        map_is_unfiltered ? depth_of_stored(MAP_GATHER(unfiltered_map, at, layer), layer) : stored_gather(at, layer);
    vec2 half_texel = vec2(0.5 / float(map_resolution));
    vec4 u = at.x + vec4(-1.0, 1.0, 1.0, -1.0) * half_texel.x, v = at.y + vec4(1.0, 1.0, -1.0, -1.0) * half_texel.y;
    return answered(depth, u, v);
}
#elif defined(RECORD_TAPS)
// One of the texels that a kernel reads, and what it weighs: the kernel's result where it alone is lit.
int tap_wanted = 0, taps_read = 0;
vec3 tap_found = vec3(0.0);  // texel, stored depth

float recorded(vec2 texel, float stored) {
    bool wanted = taps_read++ == tap_wanted;
    if (wanted) tap_found = vec3(texel, stored);
    return depth_of(wanted);
}

float map_depth(vec2 at, int layer) { return recorded(floor(at * float(map_resolution)), stored_depth(at, layer)); }

vec4 map_gather(vec2 at, int layer) {
    vec2 texel = round(at * float(map_resolution)) - 1.0;
    vec4 stored = stored_gather(at, layer);
    stored.x = recorded(texel + vec2(0.0, 1.0), stored.x);
    stored.y = recorded(texel + vec2(1.0, 1.0), stored.y);
    stored.z = recorded(texel + vec2(1.0, 0.0), stored.z);
    stored.w = recorded(texel, stored.w);
    return stored;
}
#elif defined(MARK_TEXELS)
layout(binding = IMAGE_TEXELS_READ, r32f) uniform writeonly image2D texels_read;

void mark_texel(vec2 texel, int layer) {
    ivec2 at;
    if (layer == MARK_TEXELS && wrapped_texel(texel, at)) imageStore(texels_read, at, vec4(1.0));
}

float map_depth(vec2 at, int layer) {
    mark_texel(floor(at * float(map_resolution)), layer);
    return stored_depth(at, layer);
}

vec4 map_gather(vec2 at, int layer) {
    vec2 texel = round(at * float(map_resolution)) - 1.0;
    for (int i = 0; i < 4; ++i) mark_texel(texel + vec2(i & 1, i >> 1), layer);
    return stored_gather(at, layer);
}
#else
float map_depth(vec2 at, int layer) { return stored_depth(at, layer); }
vec4 map_gather(vec2 at, int layer) { return stored_gather(at, layer); }
#endif

/// A stored depth that decides where or how a kernel compares, and is no comparison itself.
float searched_depth(vec2 at, int layer) {
#ifdef RECORD_TAPS
    return stored_depth(at, layer);
#else
    return map_depth(at, layer);
#endif
}

/// One comparison as the shadow sampler of the kernel's row makes it: with the nearest texel, or bilinearly with 2x2.
float map_compare_at(vec2 at, int layer, float own) {
#if !COMPARE_BY_HAND
    return sampler_compare(at, layer, own);
#elif SAMPLER_BILINEAR
    vec2 between = at * float(map_resolution) - 0.5, texel = floor(between), f = between - texel;
    vec4 lit = depth_test(own, map_gather((texel + 1.0) / float(map_resolution), layer));
    return mix(mix(lit.w, lit.z, f.x), mix(lit.x, lit.y, f.x), f.y);
#else
    return depth_test(own, map_depth(at, layer));
#endif
}
