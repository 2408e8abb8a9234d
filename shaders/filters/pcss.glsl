// Percentage-closer soft shadows: what stands before the receiver tells how wide the penumbra of a light of size is.
// Fernando, Percentage-Closer Soft Shadows, SIGGRAPH 2005 sketches.
#include "lib/penumbra.glsl"
#include "lib/chosen_disk.glsl"

float filter_visibility(Receiver r) {
    float own_m = compared_metres(r);
    vec2 turn = disk_turn(r);

    int searched = disk_places(filter_blocker_taps), taps = disk_places(filter_taps);
    float search = min(widest_penumbra_texels(r, own_m), filter_max_radius);
    float blocker_m = 0.0, blockers = 0.0;
    for (int i = 0; i < searched; ++i) {
        vec2 at = r.uvd_offset.xy + turned(disk_place(i, searched), turn) * (search / float(map_resolution));
        float stored = searched_depth(at, r.layer);
        float blocks = 1.0 - depth_test(compared_depth(r, at), stored);
        blocker_m += blocks * metres_at(r, stored);
        blockers += blocks;
    }
    if (blockers == 0.0) {
        found.taps = float(searched);
        return 1.0;
    }
    float gap_m = max(own_m - blocker_m / blockers, 0.0);
    float radius = clamp(penumbra_texels(r, own_m, gap_m), 0.5, filter_max_radius);
    found.blocker_m = gap_m;
    found.penumbra_texels = 2.0 * radius;
    found.taps = float(searched + taps);
    float sum = 0.0;
    for (int i = 0; i < taps; ++i)
        sum += compares_lit(r, r.uvd_offset.xy + turned(disk_place(i, taps), turn) * (radius / float(map_resolution)));
    return sum / float(taps);
}
