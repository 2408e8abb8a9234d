// What renderer/reference/precision.h found of each pixel.
#include "shared/units.h"
layout(binding = UNIT_PRECISION) uniform sampler2D precision_map;  // texels, steps of depth; below 0: neither

float found_or_nothing(float value) { return value >= 0.0 ? value : NOTHING; }
vec2 precision_here() { return texelFetch(precision_map, ivec2(gl_FragCoord.xy), 0).rg; }
