// Precision of each pixel's look-up, measured by renderer/reference/precision.h.
#include "shared/units.h"
layout(binding = UNIT_PRECISION) uniform sampler2D precision_map;  // error in texels, error in depth steps; below 0: none

float value_or_nothing(float value) { return value >= 0.0 ? value : NOTHING; }
vec2 precision_here() { return texelFetch(precision_map, ivec2(gl_FragCoord.xy), 0).rg; }
