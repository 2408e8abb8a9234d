// Percentage-closer soft shadows: what stands before the receiver tells how wide the penumbra of a light of size is.
// Fernando, Percentage-Closer Soft Shadows, SIGGRAPH 2005 sketches.
#include "lib/disk.glsl"

/// Radius in texels of the part of the map through which a receiver sees the light, past what stands `gap_m` nearer.
float penumbra_texels(Receiver r, float own_m, float gap_m) {
    float size = frame.lights[r.light].kernel.x;  // tangent of its angular radius, or its radius in metres
    bool perspective = LIGHT_PERSPECTIVE[r.light] != 0;
    float width_m = LIGHT_TYPE[r.light] == LIGHT_DIRECTIONAL ? size * gap_m
                    : perspective                            ? size * gap_m / max(own_m - gap_m, 1e-6 * own_m)
                                                             : size * gap_m / max(r.distance_m, 1e-6);
    return width_m / r.texel_m;
}

float filter_visibility(Receiver r) {
    bool perspective = LIGHT_PERSPECTIVE[r.light] != 0;
    float near = frame.views[r.layer].curve.x, far = frame.views[r.layer].curve.y;
    float own_m = metres_from_depth(clamp(r.reference, 0.0, 1.0), near, far, perspective);
    vec2 turn = disk_turn(r);

    float search = min(penumbra_texels(r, own_m, own_m - near), filter_max_radius);
    float blocker_m = 0.0, blockers = 0.0;
    for (int i = 0; i < filter_blocker_taps; ++i) {
        vec2 at = r.uvd_offset.xy + turned(POISSON_DISK[i], turn) * (search / float(map_resolution));
        float stored = searched_depth(at, r.layer);
        float blocks = 1.0 - depth_test(compared_depth(r, at), stored);
        blocker_m += blocks * metres_from_depth(stored, near, far, perspective);
        blockers += blocks;
    }
    if (blockers == 0.0) {
        found.taps = float(filter_blocker_taps);
        return 1.0;
    }
    float gap_m = max(own_m - blocker_m / blockers, 0.0);
    float radius = clamp(penumbra_texels(r, own_m, gap_m), 0.5, filter_max_radius);
    found.blocker_m = gap_m;
    found.penumbra_texels = 2.0 * radius;
    found.taps = float(filter_blocker_taps + filter_taps);
    float sum = 0.0;
    for (int i = 0; i < filter_taps; ++i)
        sum += compares_lit(r, r.uvd_offset.xy + turned(POISSON_DISK[i], turn) * (radius / float(map_resolution)));
    return sum / float(filter_taps);
}
