#include "shared/units.h"
#include "shared/frame.h"
layout(std140, binding = BLOCK_FRAME) uniform FrameUniforms { FrameBlock frame; };

// What is known of the lights when the program is made (LIGHT_* are constant arrays), so that loops over them unroll
// and whatever no light of the scene needs costs nothing.
const int LIGHT_DIRECTIONAL = 0, LIGHT_SPOT = 1, LIGHT_POINT = 2;

/// Whether all rays of a view run one way: w is 1 everywhere.
bool is_parallel(ViewBlock view) {
    mat4 m = view.uvd_from_relative;
    return m[0][3] == 0.0 && m[1][3] == 0.0 && m[2][3] == 0.0;
}
