#include "shared/units.h"
#include "shared/frame.h"
layout(std140, binding = BLOCK_FRAME) uniform FrameUniforms { FrameBlock frame; };

// What is known of the lights when the program is made (LIGHT_* are constant arrays), so that loops over them unroll
// and whatever no light of the scene needs costs nothing.
const int LIGHT_DIRECTIONAL = 0, LIGHT_SPOT = 1, LIGHT_POINT = 2;

