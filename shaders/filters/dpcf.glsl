// Percentage-closer filtering whose taps also give the caster's distance. Over the widest penumbra the shadowed share of
// a straight edge rises steadily, so a higher contrast around one half gives a narrower penumbra. Taps fill a disk: the rise
// is not linear, so only the slope in the middle is exact.
// After DPCF in Filament, which cites Myers, Shadow of Cold War, A Scalable Approach to Shadowing.
#include "lib/blockers.glsl"

float filter_visibility(Receiver r) {
    float own_m = surface_metres(r);
    vec2 turn = disk_rotation(r);
    float widest = clamp(max_penumbra_radius_texels(r, own_m), 0.5, filter_max_radius);
    Blockers blockers = search_blockers(r, own_m, turn, loop_bound(TAP_COUNT), widest, true);
    found.taps = float(TAP_COUNT);
    if (blockers.share == 0.0) return 1.0;
    float radius = penumbra_radius(blockers, r, own_m, widest);
    return clamp(0.5 + (0.5 - blockers.share) * (widest / radius), 0.0, 1.0);
}
