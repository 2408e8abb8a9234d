// State of the fragment's page: drawn, cached, or replaced by a coarser one. With map.virtual only.
#include "lib/pages.glsl"
#include "shared/colours.h"

vec4 overlay(Receiver r) {
#if MAP_PAGED
    if (r.where >= BEHIND) return vec4(0.0);
    int chosen = LIGHT_FIRST_VIEW[r.light] + choose_view(r.light, r.surface.position).view;
    uvec4 entry = page_entry_at(r.uvd.xy, r.layer);
    if (entry_state(entry) == PAGE_ABSENT) return vec4(0.0);
    if (r.layer != chosen || entry_coarser(entry) > 0) return vec4(PAGE_IS_COARSER, 1.0);
    return vec4(entry_state(entry) == PAGE_DRAWN ? PAGE_IS_DRAWN : PAGE_IS_CACHED, 1.0);
#else
    return vec4(0.0);
#endif
}
