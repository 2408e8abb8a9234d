// The disk that filter.disk chooses.
#include "lib/disk.glsl"

#if filter_disk == filter_disk_spiral
int disk_places(int taps) { return taps; }
vec2 disk_place(int i, int taps) { return spiral_place(i, taps); }
#else
int disk_places(int taps) { return min(taps, DISK_TABLE); }
vec2 disk_place(int i, int taps) { return POISSON_DISK[i]; }
#endif
