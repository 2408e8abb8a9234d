// Paged maps: a page table gives the place of each page in one pool. Texels without a requested page have no depth.
// Sakmary, Ryan, Hall, Lustri, Virtual Shadow Maps, GPU Zen 3, 2024.
#include "shared/units.h"
#include "shared/pages.h"
/// Finds the texel of a look-up by map.wrap. Returns false if the border answers.
bool wrapped_texel(vec2 texel, out ivec2 found) {
    vec2 last = MAP_SIZE - 1.0;
#if map_wrap == map_wrap_repeat
    found = ivec2(clamp(mod(texel, MAP_SIZE), vec2(0.0), last));
    return true;
#else
    found = ivec2(clamp(texel, vec2(0.0), last));
    return map_wrap != map_wrap_border || vec2(found) == texel;
#endif
}

#if MAP_PAGED
layout(binding = UNIT_PAGE_TABLE) uniform usampler2DArray page_table;  // a texel a page, a layer a view: shared/pages.h

#define NO_PAGE uintBitsToFloat(0x7fc00000u)

uvec4 page_entry(ivec2 texel, int layer) { return texelFetch(page_table, ivec3(texel / PAGE_SIZE, layer), 0); }
/// @param at map coordinates
uvec4 page_entry_at(vec2 at, int layer) {
    vec2 texel = clamp(floor(at * float(map_resolution)), vec2(0.0), vec2(float(map_resolution) - 1.0));
    return page_entry(ivec2(texel), layer);
}
int entry_state(uvec4 entry) { return int(entry.w & 255u); }
/// Returns the number of levels by which the replacing page is coarser than the requested one.
int entry_coarser(uvec4 entry) { return int(entry.w >> 8); }

/// Returns the stored depth of a texel; NO_PAGE without a page.
/// @param texel texel of the map
float paged_texel(sampler2D pool, ivec2 texel, int layer) {
    uvec4 entry = page_entry(texel, layer);
    if (entry_state(entry) == PAGE_ABSENT) return NO_PAGE;
    ivec2 part = ivec2(entry.z & 255u, entry.z >> 8);  // part of the coarser page, in pages of this level
    ivec2 within = part * PAGE_SIZE + texel % PAGE_SIZE >> entry_coarser(entry);
    return texelFetch(pool, ivec2(entry.xy) * PAGE_SIZE + within, 0).r;
}

/// Returns the depth at a texel, with the border of map.outside.
float paged_depth(sampler2D pool, vec2 texel, int layer) {
    ivec2 found;
    if (wrapped_texel(texel, found)) return paged_texel(pool, found, layer);
    return (map_outside == map_outside_lit) == (map_reversed_z == 0) ? 1.0 : 0.0;
}

float paged_depth_at(sampler2D pool, vec2 at, int layer) {
    return paged_depth(pool, floor(at * float(map_resolution)), layer);
}

/// Returns four depths in textureGather order.
/// @param at common corner of the four texels, map coordinates
vec4 paged_gather(sampler2D pool, vec2 at, int layer) {
    vec2 texel = round(at * float(map_resolution)) - 1.0;
    return vec4(paged_depth(pool, texel + vec2(0.0, 1.0), layer), paged_depth(pool, texel + vec2(1.0, 1.0), layer),
                paged_depth(pool, texel + vec2(1.0, 0.0), layer), paged_depth(pool, texel, layer));
}
#endif
