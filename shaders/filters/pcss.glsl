// Percentage-closer soft shadows: the distance of casters before the receiver gives the penumbra width.
// Fernando, Percentage-Closer Soft Shadows, SIGGRAPH 2005 sketches.
#include "lib/blockers.glsl"

float filter_visibility(Receiver r) {
    float own_m = surface_metres(r);
    vec2 turn = disk_rotation(r);

    float search = min(max_penumbra_radius_texels(r, own_m), filter_max_radius);
    int searched = searched_count(BLOCKER_COUNT, search);
    Blockers blockers = search_blockers(r, own_m, turn, searched, search, false);
    found.taps = float(searched);
    if (blockers.share == 0.0) return 1.0;
    found.taps = float(searched + TAP_COUNT);
    float radius = penumbra_radius(blockers, r, own_m, filter_max_radius);
    float sum = 0.0;
    for (int i = 0; i < loop_bound(TAP_COUNT); ++i)
        sum += compares_lit(r, r.uvd_offset.xy + disk_to_map(r, rotated(tap_place(i), turn)) * (radius / MAP_SIZE));
    return sum / float(TAP_COUNT);
}
