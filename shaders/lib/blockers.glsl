// What stands before the receiver within a disk about it, for kernels whose penumbra follows it.
#include "lib/penumbra.glsl"
#include "lib/disk.glsl"
#include "lib/disk_places.glsl"

struct Blockers {
    float share;  // of the places looked at that hold one
    float gap_m;  // how far along the axis they lie before the receiver, on average
};

/// Of so many places those that have to be searched: where they all are one, that.
int searched_count(int places, float radius_texels) {
#if SKIPS_SEARCH
    if (radius_texels == 0.0) return 1;
#endif
    return looped(places);
}

/// @param searched places of the disk, counted from the first
/// @param compares whether each is also one of the kernel's comparisons, and one of their places
Blockers blockers_within(Receiver r, float own_m, vec2 turn, int searched, float radius_texels, bool compares) {
    float blocker_m = 0.0, blockers = 0.0;
    for (int i = 0; i < searched; ++i) {
        vec2 at = r.uvd_offset.xy + on_map(r, turned(compares ? tap_place(i) : blocker_place(i), turn)) * (radius_texels / float(map_resolution));
        float stored = compares ? map_depth(at, r.layer) : searched_depth(at, r.layer);
        float blocks = 1.0 - depth_test(compared_depth(r, at), stored);
        blocker_m += blocks * held_metres(r, at, stored);
        blockers += blocks;
    }
    return Blockers(blockers / float(searched), blockers > 0.0 ? max(own_m - blocker_m / blockers, 0.0) : 0.0);
}

/// The penumbra's radius past them, kept within half a texel and `widest`; says what was found.
float radius_past(Blockers b, Receiver r, float own_m, float widest) {
    float radius = clamp(penumbra_texels(r, own_m, b.gap_m), 0.5, widest);
    found.blocker_m = b.gap_m;
    found.penumbra_texels = 2.0 * radius;
    return radius;
}
