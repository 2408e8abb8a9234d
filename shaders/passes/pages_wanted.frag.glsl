// Marks the pages of the maps that look-ups of a surface may read: all pages in the kernel's reach around the look-up, with
// and without the normal offset (trials omit the offset). Marks do not depend on the maps' content.
#include "lib/receiver.glsl"
#ifdef FROM_SCENE
layout(early_fragment_tests) in;  // hidden surfaces read no pages
#include "lib/surface.glsl"
#else
#include "lib/seen_surface.glsl"
#endif
layout(binding = IMAGE_PAGES_WANTED, r8ui) uniform writeonly uimage2DArray pages_wanted;
layout(location = 0) out float nothing_out;

/// Requests the pages of a rectangle of texels.
/// @param lo, hi first and last texel
void request_texels(vec2 lo, vec2 hi, int layer) {
    float last = float(map_resolution) - 1.0;
#if map_wrap == map_wrap_border || map_wrap == map_wrap_range
    if (any(greaterThan(lo, vec2(last))) || any(lessThan(hi, vec2(0.0)))) return;
#endif
    ivec2 first_page = ivec2(clamp(lo, vec2(0.0), vec2(last))) / PAGE_SIZE;
    ivec2 last_page = ivec2(clamp(hi, vec2(0.0), vec2(last))) / PAGE_SIZE;
    for (int y = first_page.y; y <= last_page.y; ++y)
        for (int x = first_page.x; x <= last_page.x; ++x) imageStore(pages_wanted, ivec3(x, y, layer), uvec4(1u));
}

void request_pages(Receiver r) {
    if (r.where >= BEHIND) return;
#if map_far_guard
    if (r.where == OUTSIDE_FAR) return;
#endif
    float size = float(map_resolution), reach = light_of(r.light).kernel.w + 1.5;
    vec2 lo = floor(min(r.uvd.xy, r.uvd_offset.xy) * size - reach);
    vec2 hi = floor(max(r.uvd.xy, r.uvd_offset.xy) * size + reach);
#if map_wrap == map_wrap_repeat
    // The rectangle is split among the repeated tiles that it overlaps.
    vec2 moved = floor(lo / size) * size;
    lo -= moved, hi -= moved;
    for (int tile = 0; tile < 4; ++tile) {
        vec2 from = vec2(tile & 1, tile >> 1) * size;
        if (all(greaterThanEqual(hi, from))) request_texels(max(lo - from, vec2(0.0)), hi - from, r.layer);
    }
#else
    request_texels(lo, hi, r.layer);
#endif
}

void request_pages(Surface s, int light) {
    if (LIGHT_CASTS[light] == 0 || !s.receives) return;
    Receiver r = make_receiver(s, light);
    if (!faces_light(r)) return;
    request_pages(r);
    if (r.blend > 0.0) request_pages(receiver_in(s, light, r.other_layer));
    if (LIGHT_CHOICE[light] < CHOICE_INTERVAL) return;
    // Near the end of a view another program's rounding may choose the neighbouring view, so both are requested.
    int first = LIGHT_FIRST_VIEW[light], view = r.layer - first;
    for (int i = max(view - 1, 0); i <= min(view, LIGHT_VIEWS[light] - 2); ++i) {
        float ends = view_of(first + i).span.x;
        if (abs(along_span(light, first + i, s.position) - ends) < 1e-5 * abs(ends))
            request_pages(receiver_in(s, light, first + (i < view ? i : view + 1)));
    }
}

void main() {
#ifdef FROM_SCENE
    Surface s = make_surface();
#else
    Surface s = seen_surface();
#endif
#define REQUEST_PAGES(light) request_pages(s, light);
    EACH_LIGHT(REQUEST_PAGES)
    nothing_out = 0.0;
}
