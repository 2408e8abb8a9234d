// Depths through an exponential, which pulls far occluders apart from near ones: e^(c x), x from -1 near to 1 far.
#include "lib/moments.glsl"

/// Within what the exponents' limits leave room for (safe_exponent() in renderer/settings/filters.h).
float warp_depth(float share) { return clamp(2.0 * share - 1.0, -1.1, 1.1); }

/// chebyshev() of warped depths, counted in the receiver's own so that no square overflows.
/// @param least_spread the least standard deviation, as a share of `own`
float warped_chebyshev(vec2 moments, float own, float least_spread) {
    float size = abs(own), behind = (own - moments.x) / size;
    if (behind <= 0.0) return 1.0;
    float mean = moments.x / size, variance = max(moments.y / size / size - mean * mean, least_spread * least_spread);
    return variance / (variance + behind * behind);
}

/// The variance of depths whose warped ones vary so, to first order about their mean, in squares of the range.
float unwarped_variance(vec2 moments, float exponent) {
    float spread = 2.0 * exponent * moments.x;
    return moments.y / spread / spread - 1.0 / (4.0 * exponent * exponent);
}

/// The depth that alone would have a warped mean.
float unwarped(float mean, float exponent) { return 0.5 + 0.5 * log(abs(mean)) / exponent; }
