// Percentage-closer filtering whose taps tell the occluder's distance as well: over the widest penumbra the shadowed
// share of a straight edge rises evenly, so raising its contrast about one half makes the penumbra of any narrower one.
// Guy, Agopian, Physically Based Rendering in Filament (DPCF), after Gruen, Contact Hardening Shadows Made Fast, 2010.
#include "lib/penumbra.glsl"
#include "lib/chosen_disk.glsl"

float filter_visibility(Receiver r) {
    float own_m = compared_metres(r);
    vec2 turn = disk_turn(r);
    int taps = disk_places(filter_taps);
    float widest = clamp(widest_penumbra_texels(r, own_m), 0.5, filter_max_radius);
    float blocker_m = 0.0, blockers = 0.0;
    for (int i = 0; i < taps; ++i) {
        vec2 at = r.uvd_offset.xy + turned(disk_place(i, taps), turn) * (widest / float(map_resolution));
        float stored = map_depth(at, r.layer);
        float blocks = 1.0 - depth_test(compared_depth(r, at), stored);
        blocker_m += blocks * metres_at(r, stored);
        blockers += blocks;
    }
    found.taps = float(taps);
    if (blockers == 0.0) return 1.0;
    float gap_m = max(own_m - blocker_m / blockers, 0.0);
    float radius = clamp(penumbra_texels(r, own_m, gap_m), 0.5, widest);
    found.blocker_m = gap_m;
    found.penumbra_texels = 2.0 * radius;
    return clamp(0.5 + (0.5 - blockers / float(taps)) * (widest / radius), 0.0, 1.0);
}
