// The visibility of LIGHT_INDEX that was drawn at this pixel, which is what is judged.
#include "shared/units.h"
layout(binding = UNIT_VISIBILITY) uniform sampler2DArray visibility_map;

/// What is no number is dark.
float drawn_visibility() {
    float v = texelFetch(visibility_map, ivec3(gl_FragCoord.xy, LIGHT_INDEX), 0).r;
    return isnan(v) ? 0.0 : v;
}
