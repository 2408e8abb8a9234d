// Exponential variance shadow maps with one warp: Chebyshev's bound of e^(c x). Casters near the light hardly count in it,
// so little light bleeds. Lauritzen, McCool, Layered Variance Shadow Maps, Graphics Interface 2008.
#include "lib/exponential.glsl"

vec4 moments_of(float share) {
    float warped = exp(filter_exponent * warp_depth(share));
    return vec4(warped, warped * warped, 0.0, 0.0);
}

float filter_visibility(Receiver r) {
    vec2 moments = map_moments(r, r.uvd_offset.xy).rg;
    float own = own_share(r), variance = unwarped_variance(moments, filter_exponent);
    float bound = warped_chebyshev(moments, exp(filter_exponent * warp_depth(own)),
                                   2.0 * filter_exponent * sqrt(filter_min_variance));
    record_moments(vec4(moments, UNKNOWN, UNKNOWN), unwarped(moments.x, filter_exponent), variance, variance, own, bound, 4.0);
    return without_bleeding(bound);
}
