// Kernels that go by mean and variance of the depths: the most of them that can lie at the receiver or behind it.
// Donnelly, Lauritzen, Variance Shadow Maps, I3D 2006. After lib/moments.glsl.

vec4 moments_of(float share) { return vec4(share, share * share, 0.0, 0.0); }

/// @param texels fetched for the moments
float variance_visibility(Receiver r, vec2 moments, float texels) {
    float own = own_share(r), variance = moments.y - moments.x * moments.x;
    float bound = chebyshev(moments, own, filter_min_variance);
    tell_moments(vec4(moments, UNKNOWN, UNKNOWN), moments.x, variance, variance, own, bound, texels);
    return without_bleeding(bound);
}
