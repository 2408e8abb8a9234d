// Summed-area variance shadow maps: a variance shadow map whose window is chosen at each look-up, by a table of sums.
// Lauritzen, Summed-Area Variance Shadow Maps, GPU Gems 3, chapter 8, 2007.
#include "lib/summed_area.glsl"

vec4 moments_of(float share) { return vec4(share, share * share, 0.0, 0.0); }

float filter_visibility(Receiver r) {
    vec2 moments = summed_moments(r, r.uvd_offset.xy, summed_window(r)).rg;
    float own = own_share(r), variance = moments.y - moments.x * moments.x;
    float bound = chebyshev(moments, own, filter_min_variance);
    tell_moments(vec4(moments, UNKNOWN, UNKNOWN), moments.x, variance, variance, own, bound, 16.0);
    return without_bleeding(bound);
}
