// Comparisons at places spread over a disk, rotated by an angle for each pixel.
// Uralsky, Efficient Soft-Edged Shadows Using Pixel Shader Branching, GPU Gems 2, chapter 17, 2005.
#include "lib/disk.glsl"
#include "lib/disk_places.glsl"

float filter_visibility(Receiver r) {
    vec2 radius_uv = disk_radius_texels(r) / MAP_SIZE;
    vec2 turn = disk_rotation(r);
    float sum = 0.0;
    for (int i = 0; i < loop_bound(TAP_COUNT); ++i)
        sum += compares_lit(r, r.uvd_offset.xy + radius_to_map(r, rotated(tap_place(i), turn)) * radius_uv);
    return sum / float(TAP_COUNT);
}
