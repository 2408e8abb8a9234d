// Visibility under blob shadows, as renderer/passes/blobs.cpp drew it at this pixel. Blinn, Me and My (Fake) Shadow, IEEE
// Computer Graphics and Applications 8(1), 1988.
#include "shared/units.h"
layout(binding = UNIT_BLOBS) uniform sampler2DArray blobs_map;  // a layer a light

float source_visibility(Surface s, int light) {
    if (!s.receives) return 1.0;
    if (!faces_light(s, light)) return 0.0;
    return texelFetch(blobs_map, ivec3(gl_FragCoord.xy, light), 0).r;
}
