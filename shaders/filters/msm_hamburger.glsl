// Moment shadow maps by Hamburger's problem: among all distributions of depths with the four moments, the one with
// the least share before the receiver has three depths. Peters, Klein, Moment Shadow Mapping, I3D 2015.
#include "lib/moment_problem.glsl"

float filter_visibility(Receiver r) {
    vec4 moments = map_moments(r, r.uvd_offset.xy), b = biased_moments(moments);
    float own = own_share(r);
    return moment_visibility(moments, own, share_before(b, own, other_depths(b, own)));
}
