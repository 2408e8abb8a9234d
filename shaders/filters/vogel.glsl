// Comparisons along a spiral over a disk, rotated by interleaved gradient noise.
// Vogel, A Better Way to Construct the Sunflower Head, Mathematical Biosciences 44, 1979.
#include "filters/poisson.glsl"
