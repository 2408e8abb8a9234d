// The texels that the kernel of one pixel reads, one a fragment, each with its weight.
#include "lib/seen_surface.glsl"
#include "lib/visibility.glsl"
layout(location = 0) out vec4 tap_out;  // texel (x to the right, y up, before map.wrap), stored depth, weight; below 0: none
uniform ivec2 pixel;

void main() {
    Receiver r = make_receiver(seen_surface(pixel), LIGHT_INDEX);
    r.reference = reference_of(r.reference);
    tap_wanted = int(gl_FragCoord.x);
    float weight = filter_visibility(r);
    tap_out = vec4(tap_found, tap_wanted < taps_read ? weight : -1.0);
}
