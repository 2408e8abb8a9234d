#include "shared/units.h"
#include "shared/frame.h"
layout(std140, binding = BLOCK_FRAME) uniform FrameUniforms { FrameBlock frame; };

// What is known of the lights when the program is made (LIGHT_* are constant arrays), so that loops over them unroll
// and whatever no light of the scene needs costs nothing.
const int LIGHT_DIRECTIONAL = 0, LIGHT_SPOT = 1, LIGHT_POINT = 2;

/// Whether rays run from one point: only then does depth crowd along them. A warped view's w changes across its rays.
bool is_perspective(ViewBlock view) {
    mat4 m = view.uvd_from_relative;
    return any(notEqual(vec3(m[0][3], m[1][3], m[2][3]), vec3(0.0))) && all(equal(view.warp, vec4(0.0)));
}
