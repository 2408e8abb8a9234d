// Exponential warp of depths, which separates far casters from near ones: e^(c x), x from -1 near to 1 far.
#include "lib/moments.glsl"

/// Maps a share of the depth range to x, clamped to the room that safe_exponent() leaves (renderer/settings/filters.h).
float warp_depth(float share) { return clamp(2.0 * share - 1.0, -1.1, 1.1); }

/// Returns chebyshev() of warped depths, relative to the receiver's own so that no square overflows.
/// @param least_spread least standard deviation, relative to `own`
float warped_chebyshev(vec2 moments, float own, float least_spread) {
    float size = abs(own), behind = (own - moments.x) / size;
    if (behind <= 0.0) return 1.0;
    float mean = moments.x / size, variance = max(moments.y / size / size - mean * mean, least_spread * least_spread);
    return variance / (variance + behind * behind);
}

/// Returns the variance of depths with these warped moments, to first order around the mean, in squares of the range.
float unwarped_variance(vec2 moments, float exponent) {
    float spread = 2.0 * exponent * moments.x;
    return moments.y / spread / spread - 1.0 / (4.0 * exponent * exponent);
}

/// Returns the depth with this warped value.
float unwarped(float mean, float exponent) { return 0.5 + 0.5 * log(abs(mean)) / exponent; }
