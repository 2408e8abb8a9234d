// Nearest comparisons at places that are spread over a disk, turned by an angle of each pixel's own.
// Uralsky, Efficient Soft-Edged Shadows Using Pixel Shader Branching, GPU Gems 2, chapter 17, 2005.
#include "lib/disk.glsl"
#include "lib/disk_places.glsl"

float filter_visibility(Receiver r) {
    float radius_uv = disk_radius_texels(r) / float(map_resolution);
    vec2 turn = disk_turn(r);
    float sum = 0.0;
    for (int i = 0; i < looped(TAP_COUNT); ++i)
        sum += compares_lit(r, r.uvd_offset.xy + of_radius(r, turned(tap_place(i), turn)) * radius_uv);
    return sum / float(TAP_COUNT);
}
