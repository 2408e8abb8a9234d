// Raw value of one overlay at each fragment. passes/compose.frag.glsl applies the colour scale.
#include "shared/units.h"
#include "lib/surface.glsl"
#include "lib/visibility.glsl"

#define NOTHING uintBitsToFloat(0x7fc00000u)  // NaN, drawn as "no value"; not all compilers accept it as a constant

#ifdef SEPARATE_VISIBILITY
layout(binding = UNIT_VISIBILITY) uniform sampler2DArray visibility_map;
#endif

/// Returns the visibility of this pixel, from the visibility texture if there is one.
float pixel_visibility(Receiver r) {
#ifdef SEPARATE_VISIBILITY
    return texelFetch(visibility_map, ivec3(gl_FragCoord.xy, r.light), 0).r;
#else
    return light_visibility(r.surface, r.light);
#endif
}

#include OVERLAY_FILE

layout(location = 0) out vec4 overlay_out;

void main() {
    discard_masked();
    Receiver r = make_receiver(make_surface(), LIGHT_INDEX);
    vec4 value = overlay(r);
#ifdef OVERLAY_SCALAR
    overlay_out = vec4(value.x, 0.0, 0.0, 1.0);
#else
    overlay_out = value;
#endif
}
