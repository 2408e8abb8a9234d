// Marks the pages of the maps that look-ups of a surface may read: within the kernel's reach of where it is looked up,
// with its normal offset and, as trials do, without. Whatever the kernel, and whatever the maps hold.
#include "lib/receiver.glsl"
#ifdef FROM_SCENE
layout(early_fragment_tests) in;  // what is hidden reads nothing
#include "lib/surface.glsl"
#else
#include "lib/seen_surface.glsl"
#endif
layout(binding = IMAGE_PAGES_WANTED, r8ui) uniform writeonly uimage2DArray pages_wanted;
layout(location = 0) out float nothing_out;

/// @param lo, hi texels
void want_texels(vec2 lo, vec2 hi, int layer) {
    float last = float(map_resolution) - 1.0;
#if map_wrap == map_wrap_border || map_wrap == map_wrap_range
    if (any(greaterThan(lo, vec2(last))) || any(lessThan(hi, vec2(0.0)))) return;
#endif
    ivec2 first_page = ivec2(clamp(lo, vec2(0.0), vec2(last))) / PAGE_SIZE;
    ivec2 last_page = ivec2(clamp(hi, vec2(0.0), vec2(last))) / PAGE_SIZE;
    for (int y = first_page.y; y <= last_page.y; ++y)
        for (int x = first_page.x; x <= last_page.x; ++x) imageStore(pages_wanted, ivec3(x, y, layer), uvec4(1u));
}

void want_pages(Receiver r) {
    if (r.where >= BEHIND) return;
#if map_far_guard
    if (r.where == OUTSIDE_FAR) return;
#endif
    float size = float(map_resolution), reach = light_of(r.light).kernel.w + 1.5;
    vec2 lo = floor(min(r.uvd.xy, r.uvd_offset.xy) * size - reach);
    vec2 hi = floor(max(r.uvd.xy, r.uvd_offset.xy) * size + reach);
#if map_wrap == map_wrap_repeat
    // The same place in this tile and those after it that it reaches into.
    vec2 moved = floor(lo / size) * size;
    lo -= moved, hi -= moved;
    for (int tile = 0; tile < 4; ++tile) {
        vec2 from = vec2(tile & 1, tile >> 1) * size;
        if (all(greaterThanEqual(hi, from))) want_texels(max(lo - from, vec2(0.0)), hi - from, r.layer);
    }
#else
    want_texels(lo, hi, r.layer);
#endif
}

void want_pages(Surface s, int light) {
    if (LIGHT_CASTS[light] == 0 || !s.receives) return;
    Receiver r = make_receiver(s, light);
    if (!faces_light(r)) return;
    want_pages(r);
    if (r.blend > 0.0) want_pages(receiver_in(s, light, r.other_layer));
    if (LIGHT_CHOICE[light] < CHOICE_INTERVAL) return;
    // Where the rounding of another program may choose the view beside.
    int first = LIGHT_FIRST_VIEW[light], view = r.layer - first;
    for (int i = max(view - 1, 0); i <= min(view, LIGHT_VIEWS[light] - 2); ++i) {
        float ends = view_of(first + i).span.x;
        if (abs(along_span(light, first + i, s.position) - ends) < 1e-5 * abs(ends))
            want_pages(receiver_in(s, light, first + (i < view ? i : view + 1)));
    }
}

void main() {
#ifdef FROM_SCENE
    Surface s = make_surface();
#else
    Surface s = seen_surface();
#endif
#define WANT_PAGES(light) want_pages(s, light);
    EACH_LIGHT(WANT_PAGES)
    nothing_out = 0.0;
}
