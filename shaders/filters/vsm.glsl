// Variance shadow maps: from mean and variance of the depths about the receiver, the most of them that can lie behind it.
// Donnelly, Lauritzen, Variance Shadow Maps, I3D 2006; light-bleed reduction: Lauritzen, GPU Gems 3, chapter 8, 2007.
#include "lib/moments.glsl"

float filter_visibility(Receiver r) {
    vec2 moments = map_moments(r, r.uvd_offset.xy);
    float own = share_of_range(r.reference, r);
    found.variance = moments.y - moments.x * moments.x;
    found.taps = 4.0;
    if (own <= moments.x) return 1.0;
    float variance = max(found.variance, filter_min_variance), behind = own - moments.x;
    float most = variance / (variance + behind * behind);  // Chebyshev's inequality, one-sided
    return clamp((most - filter_bleed) / (1.0 - filter_bleed), 0.0, 1.0);
}
