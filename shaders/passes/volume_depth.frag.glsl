// Exact copy of the camera's depth into a buffer that also has a stencil.
#include "shared/units.h"
layout(binding = UNIT_CAMERA_DEPTH) uniform sampler2D camera_depth_map;

void main() { gl_FragDepth = texelFetch(camera_depth_map, ivec2(gl_FragCoord.xy), 0).r; }
