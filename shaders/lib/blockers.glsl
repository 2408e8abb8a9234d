// Search for casters (blockers) before the receiver in a disk, for kernels with a variable penumbra.
#include "lib/penumbra.glsl"
#include "lib/disk.glsl"
#include "lib/disk_places.glsl"

/// Result of a blocker search.
struct Blockers {
    float share;  // share of the searched places with a blocker
    float gap_m;  // mean distance from the blockers to the receiver along the axis, metres
};

/// Returns the number of places to search: 1 if the radius is 0, so that all places coincide.
int searched_count(int places, float radius_texels) {
#if SKIPS_SEARCH
    if (radius_texels == 0.0) return 1;
#endif
    return loop_bound(places);
}

/// Searches blockers around the receiver.
/// @param searched number of places of the disk
/// @param compares the places are also the kernel's comparisons, and their taps are recorded
Blockers search_blockers(Receiver r, float own_m, vec2 turn, int searched, float radius_texels, bool compares) {
    float blocker_m = 0.0, blockers = 0.0;
    for (int i = 0; i < searched; ++i) {
        vec2 at = r.uvd_offset.xy + disk_to_map(r, rotated(compares ? tap_place(i) : blocker_place(i), turn)) * (radius_texels / MAP_SIZE);
        float stored = compares ? map_depth(at, r.layer) : searched_depth(at, r.layer);
        float blocks = 1.0 - depth_test(compared_depth(r, at), stored);
        blocker_m += blocks * clamped_metres(r, at, stored);
        blockers += blocks;
    }
    return Blockers(blockers / float(searched), blockers > 0.0 ? max(own_m - blocker_m / blockers, 0.0) : 0.0);
}

/// Returns the penumbra radius in texels for the blockers, from half a texel to `widest`. Records the result in `found`.
float penumbra_radius(Blockers b, Receiver r, float own_m, float widest) {
    float radius = clamp(penumbra_texels(r, own_m, b.gap_m), 0.5, widest);
    found.blocker_m = b.gap_m;
    found.penumbra_texels = 2.0 * radius;
    return radius;
}
