// Moment shadow maps by Hausdorff's problem: as Hamburger's, but depths lie between 0 and 1. Where the three do not, four
// take their place: both ends, the receiver's and one more. Peters, Klein, Moment Shadow Mapping, I3D 2015.
#include "lib/moment_problem.glsl"

float filter_visibility(Receiver r) {
    vec4 moments = map_moments(r, r.uvd_offset.xy), b = biased_moments(moments);
    float own = own_share(r);
    vec2 others = other_depths(b, own);
    float shadow = own <= 0.0 ? 0.0 : own >= 1.0 ? 1.0 : shadow_of_three(b, own, others);
    // The mean of z (1 - z) (z - own): where depths lie at the ends alone, rounding is all that is left of it.
    float slack = (b.y - b.z) - own * (b.x - b.y);
    if (own > 0.0 && own < 1.0 && (others.x < 0.0 || others.y > 1.0) && abs(slack) > 1e-6) {
        // The fourth depth: z (1 - z) (z - own) (z - free) is 0 at all four, so its mean is 0.
        float free = ((b.z - b.w) - own * (b.y - b.z)) / slack;
        // Weights by the polynomials that are 1 at one of them and 0 at the others.
        float at_near = (own * free - b.x * (own * free + own + free) + b.y * (own + free + 1.0) - b.z) /
                        kept_apart(own * free);
        float at_free = (b.z - b.y * (own + 1.0) + b.x * own) / kept_apart(free * (free - own) * (free - 1.0));
        shadow = at_near + (free < own ? at_free : 0.0);
    }
    return moment_visibility(moments, own, shadow);
}
