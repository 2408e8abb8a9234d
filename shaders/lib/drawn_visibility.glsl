// Drawn visibility of LIGHT_INDEX at this pixel, which is compared with the reference.
#include "shared/units.h"
layout(binding = UNIT_VISIBILITY) uniform sampler2DArray visibility_map;

/// Returns the drawn visibility; NaN counts as dark.
float drawn_visibility() {
    float v = texelFetch(visibility_map, ivec3(gl_FragCoord.xy, LIGHT_INDEX), 0).r;
    return isnan(v) ? 0.0 : v;
}
