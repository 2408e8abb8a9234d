// Variance shadow maps: an upper bound of the share of depths behind the receiver, from their mean and variance.
// Donnelly, Lauritzen, Variance Shadow Maps, I3D 2006; light-bleed reduction: Lauritzen, GPU Gems 3, chapter 8, 2007.
#include "lib/moments.glsl"
#include "lib/variance.glsl"

float filter_visibility(Receiver r) {
    return variance_visibility(r, map_moments(r, r.uvd_offset.xy).rg, 4.0);
}
