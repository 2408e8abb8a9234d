// Texels that the kernel of one pixel reads, one per fragment, with their weights (RECORD_TAPS). Otherwise further results
// of the kernel.
#include "lib/seen_surface.glsl"
#include "lib/visibility.glsl"
layout(location = 0) out vec4 tap_out;  // texel (x to the right, y up, before map.wrap), stored depth, weight; below 0: none
uniform ivec2 pixel;

void main() {
    Receiver r = make_receiver(seen_surface(pixel), LIGHT_INDEX);
#if !BIAS_PER_TEXEL
    r.reference = reference_of(r.reference);
#endif
#ifdef RECORD_TAPS
    tap_wanted = int(gl_FragCoord.x);
    float weight = filter_visibility(r);
    tap_out = vec4(tap_found, tap_wanted < taps_read ? weight : -1.0);
#else
    filter_visibility(r);
    int fragment = int(gl_FragCoord.x);
    if (fragment == 1)
        tap_out = found.moments;
    else if (fragment == 2)
        tap_out = vec4(found.mean, found.own, found.margin, found.bound);
    else
        tap_out = vec4(found.blocker_m, found.penumbra_texels, isnan(found.taps) ? frame_pixel().z : found.taps, found.variance);
#endif
}
