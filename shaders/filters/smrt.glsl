// Rays through the shadow map, each from the receiver to a place of the light. A surface of the map blocks a ray if the
// surface is before the ray by at most filter.thickness. Without filter.rotate all pixels use the same rays.
// Epic Games, Shadow Map Ray Tracing, in the documentation of Virtual Shadow Maps, Unreal Engine 5, 2021.
#include "lib/disk_places.glsl"
#include "lib/penumbra.glsl"

float filter_visibility(Receiver r) {
    // A surface blocks only if it is before the compared point. Its height is measured from the receiver's surface.
    float own_m = surface_metres(r), compared_m = compared_metres(r), near = near_plane_m(r, r.uvd_offset.xy);
    // Across the light a ray advances linearly with `t`, which is 1 at the widest penumbra. Along the light the advance is
    // linear under parallel rays. For a point light the quotient of passed and remaining distance is linear.
    bool even = LIGHT_TYPE[r.light] == LIGHT_DIRECTIONAL || LIGHT_PERSPECTIVE[r.light] == 0;
    float full = max_penumbra_radius_texels(r, own_m), widest = min(full, filter_max_radius);
    float share = full > 0.0 ? widest / full : 1.0;
    float end_m = even ? (own_m - near) * share : (own_m - near) / near * share;
    vec2 turn = disk_rotation(r);
#if filter_rotate
    float first = pixel_angle(r.surface.pixel.yx + 17.0) / 6.28318531;
#else
    float first = 0.5;
#endif
    float hits = 0.0, blocker_m = 0.0, taps = 1.0;
    // The stored depth at the receiver's own place is the same for every ray.
    float here_m = clamped_metres(r, r.uvd_offset.xy,
                                  map_depth(r.uvd_offset.xy, r.layer) - plane_within_texel(r, r.uvd_offset.xy));
    int rays = filter_rays;
#if SKIPS_SEARCH
    if (widest == 0.0 && !(here_m < compared_m)) rays = 0;  // no caster is in the way of any ray
#endif
    for (int ray = 0; ray < rays; ++ray) {
        vec2 aim = disk_to_map(r, rotated(ray_place(ray), turn)) * (widest / MAP_SIZE);
        float begun = fract(first + float(ray) * 0.754877666);  // offset of the first step, spread over the rays
        float ray_m = 0.0, stored_m = here_m, below_m = 3e38;  // below_m: place of the ray at the last step with a surface before it
        for (int i = 0; i <= filter_steps; ++i) {
            if (i > 0) {
                float t = (float(i) - 1.0 + begun) / float(filter_steps);
                ray_m = even ? t * end_m : own_m * (t * end_m) / (1.0 + t * end_m);
                vec2 at = r.uvd_offset.xy + t * aim;
                stored_m = clamped_metres(r, at, map_depth(at, r.layer) - plane_within_texel(r, at));
                taps += 1.0;
            }
            // A step covers the ray up to the next step. After the last step the interval is unlimited.
            float next = (float(i) + begun) / float(filter_steps);
            float next_m = even ? next * end_m : own_m * (next * end_m) / (1.0 + next * end_m);
            float reaches_m = i == filter_steps ? 3e38 : max(next_m, ray_m + filter_thickness);
            float gap_m = own_m - stored_m;
            bool before = stored_m < compared_m && gap_m > ray_m;
            // The test covers the whole interval between two steps, so that no surface is missed there.
            if (before ? gap_m <= reaches_m : stored_m < compared_m && gap_m > below_m) {
                hits += 1.0;
                blocker_m += gap_m;
                break;
            }
            below_m = before ? ray_m : 3e38;
        }
    }
    found.taps = taps;
    if (hits == 0.0) return 1.0;
    found.blocker_m = blocker_m / hits;
    found.penumbra_texels = 2.0 * min(penumbra_texels(r, own_m, found.blocker_m), filter_max_radius);
    return 1.0 - hits / float(filter_rays);
}
