// Difference to the picture with the reference's shadows as a person sees it: 0 none to 1.
#include "shared/units.h"
layout(binding = UNIT_FLIP) uniform sampler2D flip_map;
vec4 overlay(Receiver r) { return vec4(texelFetch(flip_map, ivec2(gl_FragCoord.xy), 0).r); }
