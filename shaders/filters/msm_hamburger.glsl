// Moment shadow maps by Hamburger's problem: of all distributions of depths with the four moments, the one with the
// least before the receiver sits at three depths. Peters, Klein, Moment Shadow Mapping, I3D 2015.
#include "lib/moment_problem.glsl"

float filter_visibility(Receiver r) {
    vec4 moments = map_moments(r, r.uvd_offset.xy), b = biased_moments(moments);
    float own = own_share(r);
    return moment_visibility(moments, own, shadow_of_three(b, own, other_depths(b, own)));
}
