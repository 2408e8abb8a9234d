// Moment shadow maps by Hausdorff's problem: as Hamburger's, with depths between 0 and 1. If the three depths are outside,
// four replace them: both ends, the receiver's and one more. Peters, Klein, Moment Shadow Mapping, I3D 2015.
#include "lib/moment_problem.glsl"

float filter_visibility(Receiver r) {
    vec4 moments = map_moments(r, r.uvd_offset.xy), b = biased_moments(moments);
    float own = own_share(r);
    vec2 others = other_depths(b, own);
    float shadow = own <= 0.0 ? 0.0 : own >= 1.0 ? 1.0 : share_before(b, own, others);
    // Mean of z (1 - z) (z - own). If all depths are at the ends, only rounding error remains.
    float slack = (b.y - b.z) - own * (b.x - b.y);
    if (own > 0.0 && own < 1.0 && (others.x < 0.0 || others.y > 1.0) && abs(slack) > 1e-6) {
        // The fourth depth: z (1 - z) (z - own) (z - free) is 0 at all four, so its mean is 0.
        float free = ((b.z - b.w) - own * (b.y - b.z)) / slack;
        // Each weight comes from the polynomial that is 1 at its depth and 0 at the others.
        float at_near = (own * free - b.x * (own * free + own + free) + b.y * (own + free + 1.0) - b.z) /
                        away_from_zero(own * free);
        float at_free = (b.z - b.y * (own + 1.0) + b.x * own) / away_from_zero(free * (free - own) * (free - 1.0));
        shadow = at_near + (free < own ? at_free : 0.0);
    }
    return moment_visibility(moments, own, shadow);
}
