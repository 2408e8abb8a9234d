// The camera's depth again, bit by bit, in a buffer that has a stencil beside it.
#include "shared/units.h"
layout(binding = UNIT_CAMERA_DEPTH) uniform sampler2D camera_depth_map;

void main() { gl_FragDepth = texelFetch(camera_depth_map, ivec2(gl_FragCoord.xy), 0).r; }
