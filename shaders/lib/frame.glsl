#include "shared/frame.h"
layout(std140, binding = 0) uniform FrameUniforms { FrameBlock frame; };
