// Exponential variance shadow maps with two warps: the lower of the bounds by e^(c x) and by -e^(-d x). The second bound is
// tight where the first is not, near receivers behind a far one. Lauritzen, McCool, Layered Variance Shadow Maps,
// Graphics Interface 2008.
#include "lib/exponential.glsl"

vec4 moments_of(float share) {
    float x = warp_depth(share), risen = exp(filter_exponent * x), fallen = -exp(-filter_negative_exponent * x);
    return vec4(risen, risen * risen, fallen, fallen * fallen);
}

float filter_visibility(Receiver r) {
    vec4 moments = map_moments(r, r.uvd_offset.xy);
    float own = own_share(r), x = warp_depth(own), spread = 2.0 * sqrt(filter_min_variance);
    float by_risen = warped_chebyshev(moments.xy, exp(filter_exponent * x), spread * filter_exponent);
    float by_fallen = warped_chebyshev(moments.zw, -exp(-filter_negative_exponent * x), spread * filter_negative_exponent);
    float bound = min(by_risen, by_fallen), variance = unwarped_variance(moments.zw, filter_negative_exponent);
    record_moments(moments, unwarped(moments.z, -filter_negative_exponent), variance,
                 min(variance, unwarped_variance(moments.xy, filter_exponent)), own, bound, 4.0);
    return without_bleeding(bound);
}
