// The shadow maps: one picture is a plain texture, several are the layers of an array.
#if MAP_LAYERS > 1
layout(binding = 0) uniform sampler2DArray shadow_map;               // nearest, no comparison
layout(binding = 1) uniform sampler2DArrayShadow shadow_map_compare; // comparison as map_compare has it
float map_depth(vec2 at, int layer) { return texture(shadow_map, vec3(at, layer)).r; }
vec4 map_gather(vec2 at, int layer) { return textureGather(shadow_map, vec3(at, layer)); }
float map_compare_at(vec2 at, int layer, float own) { return texture(shadow_map_compare, vec4(at, layer, own)); }
#else
layout(binding = 0) uniform sampler2D shadow_map;
layout(binding = 1) uniform sampler2DShadow shadow_map_compare;
float map_depth(vec2 at, int layer) { return texture(shadow_map, at).r; }
vec4 map_gather(vec2 at, int layer) { return textureGather(shadow_map, at); }
float map_compare_at(vec2 at, int layer, float own) { return texture(shadow_map_compare, vec3(at, own)); }
#endif
