// Variance shadow maps: from mean and variance of the depths about the receiver, the most of them that can lie behind it.
// Donnelly, Lauritzen, Variance Shadow Maps, I3D 2006; light-bleed reduction: Lauritzen, GPU Gems 3, chapter 8, 2007.
#include "lib/moments.glsl"

vec4 moments_of(float share) { return vec4(share, share * share, 0.0, 0.0); }

float filter_visibility(Receiver r) {
    vec2 moments = map_moments(r, r.uvd_offset.xy).rg;
    float own = own_share(r), variance = moments.y - moments.x * moments.x;
    float bound = chebyshev(moments, own, filter_min_variance);
    tell_moments(vec4(moments, UNKNOWN, UNKNOWN), moments.x, variance, variance, own, bound, 4.0);
    return without_bleeding(bound);
}
