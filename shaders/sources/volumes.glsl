// Visibility by shadow volumes: 1 outside all volumes, as renderer/passes/shadow_volumes.cpp counted at this pixel.
// Crow, Shadow Algorithms for Computer Graphics, SIGGRAPH 1977; Everitt and Kilgard, Practical and Robust Stenciled
// Shadow Volumes for Hardware-Accelerated Rendering, 2002.
#include "shared/units.h"
layout(binding = UNIT_VOLUMES) uniform sampler2DArray volumes_map;  // a layer a light: 1 outside all volumes

float source_visibility(Surface s, int light) {
    if (!s.receives) return 1.0;
    // A surface that faces away from the light shadows itself at any thickness.
    if (!faces_light(s, light)) return 0.0;
    return texelFetch(volumes_map, ivec3(gl_FragCoord.xy, light), 0).r;
}
