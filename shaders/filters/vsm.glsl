// Variance shadow maps: from mean and variance of the depths about the receiver, the most of them that can lie behind it.
// Donnelly, Lauritzen, Variance Shadow Maps, I3D 2006; light-bleed reduction: Lauritzen, GPU Gems 3, chapter 8, 2007.
#include "lib/moments.glsl"
#include "lib/variance.glsl"

float filter_visibility(Receiver r) {
    return variance_visibility(r, map_moments(r, r.uvd_offset.xy).rg, 4.0);
}
