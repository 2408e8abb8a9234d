// Percentage-closer filtering whose taps tell the occluder's distance as well: over the widest penumbra the shadowed
// share of a straight edge rises evenly, so raising its contrast about one half makes the penumbra of any narrower one.
// Guy, Agopian, Physically Based Rendering in Filament (DPCF), after Gruen, Contact Hardening Shadows Made Fast, 2010.
#include "lib/blockers.glsl"

float filter_visibility(Receiver r) {
    float own_m = compared_metres(r);
    vec2 turn = disk_turn(r);
    float widest = clamp(max_penumbra_radius_texels(r, own_m), 0.5, filter_max_radius);
    Blockers blockers = blockers_within(r, own_m, turn, looped(TAP_COUNT), widest, true);
    found.taps = float(TAP_COUNT);
    if (blockers.share == 0.0) return 1.0;
    float radius = radius_past(blockers, r, own_m, widest);
    return clamp(0.5 + (0.5 - blockers.share) * (widest / radius), 0.0, 1.0);
}
