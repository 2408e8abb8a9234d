// Summed-area variance shadow maps: a variance shadow map with a summed-area table, so that each look-up chooses its window.
// Lauritzen, Summed-Area Variance Shadow Maps, GPU Gems 3, chapter 8, 2007.
#include "lib/summed_area.glsl"
#include "lib/variance.glsl"

float filter_visibility(Receiver r) {
    return variance_visibility(r, summed_moments(r, r.uvd_offset.xy, summed_window(r)).rg, 16.0);
}
