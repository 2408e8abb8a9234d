// Nearest comparisons along a spiral over a disk, rotated by interleaved gradient noise.
// Vogel, A Better Way to Construct the Sunflower Head, Mathematical Biosciences 44, 1979.
#include "lib/disk.glsl"
#include "lib/disk_places.glsl"

float filter_visibility(Receiver r) {
    float radius_uv = disk_radius_texels(r) / float(map_resolution);
    vec2 turn = disk_rotation(r);
    float sum = 0.0;
    for (int i = 0; i < loop_bound(TAP_COUNT); ++i)
        sum += compares_lit(r, r.uvd_offset.xy + radius_to_map(r, rotated(tap_place(i), turn)) * radius_uv);
    return sum / float(TAP_COUNT);
}
