// Places of the unit disk (renderer/base/poisson_disk.h). *_PLACES are lists of constants, or 0 for too many places.
// Compilers for CPUs resolve constants only in unrolled loops, so places otherwise come from a buffer.
#if DISK_FROM_IMAGE
layout(rg32ui, binding = IMAGE_DISK_PLACES) restrict readonly uniform uimageBuffer disk_texels;
vec2 disk_texel(int i) { return uintBitsToFloat(imageLoad(disk_texels, i).xy); }
vec2 tap_place(int i) { return disk_texel(i); }
vec2 blocker_place(int i) { return disk_texel(TAP_COUNT + i); }
vec2 ray_place(int i) { return disk_texel(TAP_COUNT + BLOCKER_COUNT + i); }
#else
vec2 spiral_place(int i, int n) {
    // The golden angle as an integer fraction of a turn, so that whole turns wrap without rounding.
    float angle = float(uint(i) * 2654435769u) * (6.28318531 / 4294967296.0);
    return sqrt((float(i) + 0.5) / float(n)) * vec2(cos(angle), sin(angle));
}
#if TAP_COUNT <= DISK_CONSTANTS
const vec2 tap_places[TAP_COUNT] = TAP_PLACES;
vec2 tap_place(int i) { return tap_places[i]; }
#else
vec2 tap_place(int i) { return spiral_place(i, TAP_COUNT); }
#endif
#if BLOCKER_COUNT <= DISK_CONSTANTS
const vec2 blocker_places[BLOCKER_COUNT] = BLOCKER_PLACES;
vec2 blocker_place(int i) { return blocker_places[i]; }
#else
vec2 blocker_place(int i) { return spiral_place(i, BLOCKER_COUNT); }
#endif
#if RAY_COUNT <= DISK_CONSTANTS
const vec2 ray_places[RAY_COUNT] = RAY_PLACES;
vec2 ray_place(int i) { return ray_places[i]; }
#else
vec2 ray_place(int i) { return spiral_place(i, RAY_COUNT); }
#endif
#endif
