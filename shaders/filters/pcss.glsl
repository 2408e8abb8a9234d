// Percentage-closer soft shadows: what stands before the receiver tells how wide the penumbra of a light of size is.
// Fernando, Percentage-Closer Soft Shadows, SIGGRAPH 2005 sketches.
#include "lib/blockers.glsl"

float filter_visibility(Receiver r) {
    float own_m = compared_metres(r);
    vec2 turn = disk_turn(r);

    float search = min(widest_penumbra_texels(r, own_m), filter_max_radius);
    int searched = searched_count(BLOCKER_COUNT, search);
    Blockers blockers = blockers_within(r, own_m, turn, searched, search, false);
    found.taps = float(searched);
    if (blockers.share == 0.0) return 1.0;
    found.taps = float(searched + TAP_COUNT);
    float radius = radius_past(blockers, r, own_m, filter_max_radius);
    float sum = 0.0;
    for (int i = 0; i < looped(TAP_COUNT); ++i)
        sum += compares_lit(r, r.uvd_offset.xy + on_map(r, turned(tap_place(i), turn)) * (radius / float(map_resolution)));
    return sum / float(TAP_COUNT);
}
