// The shadow maps: one picture is a plain texture, several are the layers of an array.
#if MAP_LAYERS > 1
layout(binding = 0) uniform sampler2DArray shadow_map;               // nearest, no comparison
layout(binding = 1) uniform sampler2DArrayShadow shadow_map_compare; // comparison as map_compare has it
float stored_depth(vec2 at, int layer) { return texture(shadow_map, vec3(at, layer)).r; }
vec4 stored_gather(vec2 at, int layer) { return textureGather(shadow_map, vec3(at, layer)); }
float map_compare_at(vec2 at, int layer, float own) { return texture(shadow_map_compare, vec4(at, layer, own)); }
#else
layout(binding = 0) uniform sampler2D shadow_map;
layout(binding = 1) uniform sampler2DShadow shadow_map_compare;
float stored_depth(vec2 at, int layer) { return texture(shadow_map, at).r; }
vec4 stored_gather(vec2 at, int layer) { return textureGather(shadow_map, at); }
float map_compare_at(vec2 at, int layer, float own) { return texture(shadow_map_compare, vec3(at, own)); }
#endif

#ifdef MAP_TRIALS
// The same kernels on another map, and with an answer in place of what lies beyond the map's sides.
#if MAP_LAYERS > 1
layout(binding = 10) uniform sampler2DArray unfiltered_map;
#define UNFILTERED(at, layer) vec3(at, layer)
#else
layout(binding = 10) uniform sampler2D unfiltered_map;
#define UNFILTERED(at, layer) at
#endif
bool map_is_unfiltered = false;
float beyond_answer = -1.0;  // visibility of taps beyond the sides; below 0: as map.wrap has it

vec4 answered(vec4 depth, vec4 u, vec4 v) {
#if !SEAM_TRIALS
    return depth;
#endif
    if (beyond_answer < 0.0) return depth;
    // Beyond every depth on the side that answers.
    float always = (beyond_answer > 0.5) == (map_reversed_z == 0) ? 3e38 : -3e38;
    bvec4 inside = bvec4(ivec4(greaterThanEqual(u, vec4(0.0))) * ivec4(lessThanEqual(u, vec4(1.0))) *
                         ivec4(greaterThanEqual(v, vec4(0.0))) * ivec4(lessThanEqual(v, vec4(1.0))));
    return mix(vec4(always), depth, inside);
}

float map_depth(vec2 at, int layer) {
    float depth = map_is_unfiltered ? texture(unfiltered_map, UNFILTERED(at, layer)).r : stored_depth(at, layer);
    return answered(vec4(depth), at.xxxx, at.yyyy).x;
}

/// @param at where four texels meet
vec4 map_gather(vec2 at, int layer) {
    vec4 depth = map_is_unfiltered ? textureGather(unfiltered_map, UNFILTERED(at, layer)) : stored_gather(at, layer);
    vec2 half_texel = vec2(0.5 / float(map_resolution));
    vec4 u = at.x + vec4(-1.0, 1.0, 1.0, -1.0) * half_texel.x, v = at.y + vec4(1.0, 1.0, -1.0, -1.0) * half_texel.y;
    return answered(depth, u, v);
}
#else
float map_depth(vec2 at, int layer) { return stored_depth(at, layer); }
vec4 map_gather(vec2 at, int layer) { return stored_gather(at, layer); }
#endif
