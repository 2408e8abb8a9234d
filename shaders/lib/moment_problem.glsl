// Least share of depths before a receiver, from four moments. The distributions that reach the bound have few depths, the
// receiver's among them. Peters, Klein, Moment Shadow Mapping, I3D 2015.
#include "lib/moments.glsl"

vec4 moments_of(float share) {
    float square = share * share;
    return vec4(share, square, square * share, square * square);
}

/// Blends moments with one half by filter.moment_bias, since rounding leaves moments of no distribution.
vec4 biased_moments(vec4 moments) { return mix(moments, vec4(0.5), filter_moment_bias); }

/// Returns the smaller determinant of the moments; below 0 no distribution has these moments.
float moment_margin(vec4 b) {
    float variance = b.y - b.x * b.x, skewed = b.z - b.x * b.y;
    return min(variance, (b.w - b.y * b.y) - skewed * skewed / max(variance, 1e-12));
}

/// Returns the two other depths of the distribution at three depths with these moments, one depth being `own`; the nearer
/// first. They are the roots of the polynomial with B c = (1, own, own^2), B the Hankel matrix, solved by B = L D L^T.
vec2 other_depths(vec4 b, float own) {
    float d2 = max(b.y - b.x * b.x, 1e-12), l32 = (b.z - b.x * b.y) / d2;
    float d3 = max(b.w - b.y * b.y - l32 * l32 * d2, 1e-14);
    float y2 = own - b.x, y3 = own * own - b.y - l32 * y2;
    float c2 = y3 / d3, c1 = y2 / d2 - l32 * c2, c0 = 1.0 - b.x * c1 - b.y * c2;
    // c2 is 0 if one of the depths is infinite; a large depth is enough.
    if (abs(c2) < 1e-20) c2 = c2 < 0.0 ? -1e-20 : 1e-20;
    float centre = -0.5 * c1 / c2, radius = sqrt(max(centre * centre - c0 / c2, 0.0));
    return vec2(centre - radius, centre + radius);
}

/// Returns the distance, at least 1e-9 in size.
float away_from_zero(float distance) { return abs(distance) < 1e-9 ? (distance < 0.0 ? -1e-9 : 1e-9) : distance; }

/// Returns the weight of a depth in a distribution at three depths with moments 1, b.x, b.y.
float weight_of_three(float at, float second, float third, vec4 b) {
    return (b.y - b.x * (second + third) + second * third) / (away_from_zero(at - second) * away_from_zero(at - third));
}

/// Returns the share before `own` of the distribution at three depths.
float share_before(vec4 b, float own, vec2 others) {
    if (others.y < own) return 1.0 - weight_of_three(own, others.x, others.y, b);
    if (others.x < own) return weight_of_three(others.x, own, others.y, b);
    return 0.0;
}

/// Returns the upper bound of visibility after light-bleed reduction. Records the moments in `found`.
float moment_visibility(vec4 moments, float own, float shadow) {
    float bound = 1.0 - clamp(shadow, 0.0, 1.0);
    record_moments(moments, moments.x, moments.y - moments.x * moments.x, moment_margin(moments), own, bound, 4.0);
    return without_bleeding(bound);
}
