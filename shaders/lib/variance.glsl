// Variance kernels: upper bound of the share of depths at the receiver or behind, by mean and variance.
// Donnelly, Lauritzen, Variance Shadow Maps, I3D 2006. Include after lib/moments.glsl.

vec4 moments_of(float share) { return vec4(share, share * share, 0.0, 0.0); }

/// Returns the visibility by mean and mean square of depth, after light-bleed reduction.
/// @param texels number of texels fetched for the moments
float variance_visibility(Receiver r, vec2 moments, float texels) {
    float own = own_share(r), variance = moments.y - moments.x * moments.x;
    float bound = chebyshev(moments, own, filter_min_variance);
    record_moments(vec4(moments, UNKNOWN, UNKNOWN), moments.x, variance, variance, own, bound, texels);
    return without_bleeding(bound);
}
