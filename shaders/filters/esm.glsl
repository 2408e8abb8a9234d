// Exponential shadow maps: the lit share is the mean of e^(c (x - own)) with depths x from -1 to 1, which separates a step
// from a slope if c is large. Annen, Mertens, Seidel, Flerackers, Kautz, Exponential Shadow Maps, Graphics Interface 2008.
#include "lib/exponential.glsl"

vec4 moments_of(float share) { return vec4(exp(filter_exponent * warp_depth(share)), 0.0, 0.0, 0.0); }

float filter_visibility(Receiver r) {
    float mean = map_moments(r, r.uvd_offset.xy).r, own = own_share(r);
    // Logarithms avoid overflow of the product's factors.
    float bound = min(exp(log(mean) - filter_exponent * (2.0 * own - 1.0)), 1.0);
    float share = unwarped(mean, filter_exponent);
    record_moments(vec4(mean, UNKNOWN, UNKNOWN, UNKNOWN), share, UNKNOWN, min(share, 1.0 - share) + 1e-3, own, bound, 4.0);
    return bound;
}
